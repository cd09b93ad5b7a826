#include "motion_lanes.h"

#include "corner_lanes.h"

namespace quadrille {
namespace {

constexpr int kGroups = FitBatch::kSize / kLaneCount;

/// Whether corner k lies at parameter 1.
constexpr int kAtU[4] = {0, 1, 1, 0}, kAtV[4] = {0, 0, 1, 1};

QUADRILLE_INLINE void powers(const Lanes& t, Lanes (&linear)[2], Lanes (&quadratic)[3],
                             Lanes (&quartic)[5]) {
  const Lanes s = 1.0f - t, s2 = s * s, t2 = t * t, st = s * t;
  linear[0] = s, linear[1] = t;
  quadratic[0] = s2, quadratic[1] = st, quadratic[2] = t2;
  quartic[0] = s2 * s2, quartic[1] = s2 * st, quartic[2] = s2 * t2;
  quartic[3] = st * t2, quartic[4] = t2 * t2;
}

}  // namespace

QUADRILLE_MULTIVERSION
void add_batch(int channels, const MotionBatch& batch, MotionSums& sums) {
  const int groups = batch.count / kLaneCount;
  Lanes linear_u[kGroups][2], linear_v[kGroups][2], quadratic_u[kGroups][3],
      quadratic_v[kGroups][3];
  Lanes quartic_u[kGroups][5], quartic_v[kGroups][5];
  Lanes gradient[4][2][kGroups], product[3][kGroups], pull[2][kGroups];
  for (int g = 0; g < groups; ++g) {
    Lanes u, v;
    load(batch.u + kLaneCount * g, u);
    load(batch.v + kLaneCount * g, v);
    powers(u, linear_u[g], quadratic_u[g], quartic_u[g]);
    powers(v, linear_v[g], quadratic_v[g], quartic_v[g]);
    const Lanes zero = {};
    for (auto& p : product) p[g] = zero;
    for (auto& p : pull) p[g] = zero;
    Lanes x[4], y[4], residual[4];
    load_channels([&](int p) { return batch.gradient[0][kLaneCount * g + p].data(); }, x);
    load_channels([&](int p) { return batch.gradient[1][kLaneCount * g + p].data(); }, y);
    load_channels([&](int p) { return batch.residual[kLaneCount * g + p].data(); }, residual);
    for (int c = 0; c < channels; ++c) {
      product[0][g] += x[c] * x[c];
      product[1][g] += x[c] * y[c];
      product[2][g] += y[c] * y[c];
      pull[0][g] += x[c] * residual[c];
      pull[1][g] += y[c] * residual[c];
      gradient[c][0][g] = x[c];
      gradient[c][1][g] = y[c];
    }
  }
  for (int c = 0; c < channels; ++c) {
    for (int d = 0; d < 2; ++d) {
      add_products(groups, gradient[c][d], quartic_u, quartic_v, sums.mixed[c][d]);
    }
  }
  for (int s = 0; s < 3; ++s) {
    add_products(groups, product[s], quadratic_u, quadratic_v, sums.stiffness[s]);
  }
  Lanes force[8];
  for (int k = 0; k < 4; ++k) {
    for (int d = 0; d < 2; ++d) {
      Lanes sum = {};
      for (int g = 0; g < groups; ++g) {
        sum += pull[d][g] * linear_u[g][kAtU[k]] * linear_v[g][kAtV[k]];
      }
      force[2 * k + d] = sum;
    }
  }
  add_sums<8>(force, sums.force[0]);
}

QUADRILLE_MULTIVERSION
void multiply(const ElementGroup& group, const MotionGroup& motion, int channels,
              const WedgeUnknowns* x, const Eigen::Vector2f* p, CornerUnknowns* colors,
              CornerMoves* moves) {
  CornerLanes local[4];
  float given[8][kLaneCount];
  gather_corners(group, x, local);
  for (int k = 0; k < 4; ++k) {
    for (int lane = 0; lane < kLaneCount; ++lane) {
      const Eigen::Vector2f& move = p[motion.vertices[k][lane]];
      given[2 * k][lane] = move.x();
      given[2 * k + 1][lane] = move.y();
    }
  }
  Lanes move[8], result[8] = {};
#pragma GCC unroll 8
  for (int a = 0; a < 8; ++a) load(given[a], move[a]);
  for (int a = 0; a < 8; ++a) {
#pragma GCC unroll 8
    for (int b = 0; b < 8; ++b) {
      Lanes entry;
      load(motion.stiffness[8 * a + b], entry);
      result[a] += entry * move[b];
    }
  }
  for (int c = 0; c < channels; ++c) {
    ControlLanes in, out;
    to_control(group, local[c], in);
    multiply_moments(group.moments, in, out);
    for (int d = 0; d < 2; ++d) {
      for (int j = 0; j < 4; ++j) {
#pragma GCC unroll 4
        for (int k = 0; k < 4; ++k) {
          const float(*const row)[kLaneCount] = motion.mixed[c][d] + 5 * (j + kAtV[k]) + kAtU[k];
#pragma GCC unroll 4
          for (int i = 0; i < 4; ++i) {
            Lanes moment;
            load(row[i], moment);
            out[4 * j + i] -= moment * move[2 * k + d];
            result[2 * k + d] -= moment * in[4 * j + i];
          }
        }
      }
    }
    from_control(group, out, local[c]);
  }
  scatter_corners(local, channels, colors);
  for (int a = 0; a < 8; ++a) {
    for (int lane = 0; lane < kLaneCount; ++lane) moves[lane][a / 2][a % 2] = result[a][lane];
  }
}

}  // namespace quadrille
