#include "fit_lanes.h"

#include "bernstein_lanes.h"

namespace quadrille {
namespace {

constexpr int kGroups = FitBatch::kSize / kLaneCount;

/// t^p (1 - t)^(6 - p).
QUADRILLE_INLINE void sextic_powers(const Lanes& t, Lanes (&b)[7]) {
  const Lanes s = 1.0f - t, s2 = s * s, t2 = t * t, s3 = s2 * s, t3 = t2 * t;
  b[0] = s3 * s3;
  b[1] = s3 * s2 * t;
  b[2] = s2 * s2 * t2;
  b[3] = s3 * t3;
  b[4] = s2 * t2 * t2;
  b[5] = s * t2 * t3;
  b[6] = t3 * t3;
}

/// Relative to the first control colour, so that constants cancel without rounding.
QUADRILLE_INLINE void difference(const float (&model)[16], const Lanes (&bu)[4],
                                 const Lanes (&bv)[4], const Lanes& color, Lanes& result) {
  result = color - model[0];
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j) {
    float m[4];
    for (int i = 0; i < 4; ++i) m[i] = model[4 * j + i] - model[0];
    result -= (m[0] * bu[0] + m[1] * bu[1] + m[2] * bu[2] + m[3] * bu[3]) * bv[j];
  }
}

}  // namespace

QUADRILLE_MULTIVERSION
void add_batch(const ControlColors& model, int channels, const FitBatch& batch, FitSums& sums) {
  const int groups = batch.count / kLaneCount;
  Lanes cubic_u[kGroups][4], cubic_v[kGroups][4], sextic_u[kGroups][7], sextic_v[kGroups][7];
  Lanes residual[4][kGroups];
  for (int g = 0; g < groups; ++g) {
    Lanes u, v, weight;
    load(batch.u + kLaneCount * g, u);
    load(batch.v + kLaneCount * g, v);
    load(batch.weight + kLaneCount * g, weight);
    cubic_bernstein(u, cubic_u[g]);
    cubic_bernstein(v, cubic_v[g]);
    sextic_powers(u, sextic_u[g]);
    sextic_powers(v, sextic_v[g]);
#pragma GCC unroll 7
    for (Lanes& power : sextic_v[g]) power *= weight;
    Lanes color[4];
    load_channels([&](int p) { return batch.color[kLaneCount * g + p].data(); }, color);
    for (int c = 0; c < channels; ++c) {
      difference(model[c], cubic_u[g], cubic_v[g], color[c], residual[c][g]);
      residual[c][g] *= weight;
    }
  }
  Lanes moments[padded_count(49)];
  for (int i = 49; i < padded_count(49); ++i) moments[i] = Lanes{};
  for (int q = 0; q < 7; ++q) {
    Lanes sum[7] = {};
    for (int g = 0; g < groups; ++g) {
#pragma GCC unroll 7
      for (int p = 0; p < 7; ++p) sum[p] += sextic_u[g][p] * sextic_v[g][q];
    }
#pragma GCC unroll 7
    for (int p = 0; p < 7; ++p) moments[7 * q + p] = sum[p];
  }
  add_sums<49>(moments, sums.moments);
  for (int c = 0; c < channels; ++c) {
    add_products(groups, residual[c], cubic_u, cubic_v, sums.residual[c]);
  }
}

QUADRILLE_MULTIVERSION
void evaluate_batch(const ControlColors& model, int channels, int count, const float* u,
                    const float* v, float (&colors)[4][FitBatch::kSize]) {
  for (int i = 0; i < count; i += kLaneCount) {
    Lanes at_u, at_v, bu[4], bv[4];
    load(u + i, at_u);
    load(v + i, at_v);
    cubic_bernstein(at_u, bu);
    cubic_bernstein(at_v, bv);
    for (int c = 0; c < channels; ++c) {
      const Lanes zero = {};
      Lanes negative;
      difference(model[c], bu, bv, zero, negative);
      store(-negative, colors[c] + i);
    }
  }
}

}  // namespace quadrille
