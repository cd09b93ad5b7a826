#include "patch_lanes.h"

#include <cstring>

namespace quadrille {
namespace {

using Mask = int __attribute__((vector_size(4 * kLaneCount)));

constexpr int kMaxNewtonSteps = 6;
/// Newton's method converges quadratically: after a step of this length the parameters are good to
/// about 1e-5.
constexpr float kConvergedStep = 1e-3f;
/// Parameters may end this far outside the square; the outline is scanned as a polyline.
constexpr float kMargin = 0.02f;

struct Surface {
  Lanes value, du, dv;
};

QUADRILLE_INLINE void evaluate(const float* c, const Lanes& u, const Lanes& v, Surface& s) {
  Lanes row[4], row_du[4];
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j) {
    const Lanes b2 = c[4 * j + 3] * u + c[4 * j + 2];
    const Lanes b1 = b2 * u + c[4 * j + 1];
    row[j] = b1 * u + c[4 * j];
    row_du[j] = (c[4 * j + 3] * u + b2) * u + b1;
  }
  const Lanes b2 = row[3] * v + row[2];
  const Lanes b1 = b2 * v + row[1];
  s.value = b1 * v + row[0];
  s.du = ((row_du[3] * v + row_du[2]) * v + row_du[1]) * v + row_du[0];
  s.dv = (row[3] * v + b2) * v + b1;
}

template <class T>
QUADRILLE_INLINE void clamp(T& x, const T& low, const T& high) {
  x = x > low ? x : low;
  x = x < high ? x : high;
}

QUADRILLE_INLINE void absolute(const Lanes& x, Lanes& result) { result = x < 0 ? -x : x; }

QUADRILLE_INLINE bool any(const Mask& mask) {
  long long parts[sizeof(Mask) / sizeof(long long)], all = 0;
  std::memcpy(parts, &mask, sizeof mask);
  for (const long long part : parts) all |= part;
  return all != 0;
}

QUADRILLE_INLINE void invert(const GeometryCoefficients& c, const Lanes& given_x,
                             const Lanes& given_y, Lanes& u, Lanes& v, Mask& found) {
  const Lanes x = c.map[0][0] * given_x + c.map[0][1] * given_y + c.map[0][2];
  const Lanes y = c.map[1][0] * given_x + c.map[1][1] * given_y + c.map[1][2];
  const Lanes zero = {}, one = zero + 1.0f;
  Lanes start[2];
  for (int d = 0; d < 2; ++d) {
    const float* const s = c.start[d];
    start[d] = s[0] + s[1] * x + s[2] * y + (s[3] * x + s[4] * y) * x + s[5] * y * y;
    clamp(start[d], zero, one);
  }
  u = start[0], v = start[1];
  Mask active = zero == zero;
  found = active ^ active;
  for (int step = 0; step < kMaxNewtonSteps && any(active); ++step) {
    Surface sx, sy;
    evaluate(c.position[0], u, v, sx);
    evaluate(c.position[1], u, v, sy);
    const Lanes miss_x = x - sx.value, miss_y = y - sy.value;
    const Lanes determinant = sx.du * sy.dv - sx.dv * sy.du;
    const Lanes inverse = 1.0f / determinant;
    const Lanes step_u = (miss_x * sy.dv - miss_y * sx.dv) * inverse;
    const Lanes step_v = (sx.du * miss_y - sy.du * miss_x) * inverse;
    u = active ? u + step_u : u;
    v = active ? v + step_v : v;
    Lanes length_u, length_v, off_u, off_v;
    absolute(step_u, length_u);
    absolute(step_v, length_v);
    absolute(u - 0.5f, off_u);
    absolute(v - 0.5f, off_v);
    // A lane that leaves the neighbourhood of the square, or meets a fold, has failed.
    const Mask sound = (determinant > 0) & (off_u < 1.0f) & (off_v < 1.0f);
    const Mask small = length_u + length_v < kConvergedStep;
    found |= active & sound & small & (off_u < 0.5f + kMargin) & (off_v < 0.5f + kMargin);
    active &= sound & ~small;
  }
  clamp(u, zero, one);
  clamp(v, zero, one);
}

}  // namespace

GeometryCoefficients geometry_coefficients(const NormalizedPatch& normalized,
                                           const Eigen::Affine2d& map) {
  GeometryCoefficients c;
  for (int d = 0; d < 2; ++d) {
    for (int k = 0; k < 3; ++k) c.map[d][k] = static_cast<float>(map(d, k));
    for (int k = 0; k < 6; ++k) c.start[d][k] = static_cast<float>(normalized.start[k][d]);
    for (int k = 0; k < 16; ++k) {
      c.position[d][k] = static_cast<float>(normalized.position[k / 4][k % 4][d]);
    }
  }
  return c;
}

QUADRILLE_MULTIVERSION
void invert_lanes(const GeometryCoefficients& c, const PointBatch& batch) {
  for (int i = 0; i < batch.count; i += kLaneCount) {
    Lanes x, y, u, v;
    std::memcpy(&x, batch.x + i, sizeof x);
    std::memcpy(&y, batch.y + i, sizeof y);
    Mask found;
    invert(c, x, y, u, v, found);
    std::memcpy(batch.u + i, &u, sizeof u);
    std::memcpy(batch.v + i, &v, sizeof v);
    std::memcpy(batch.found + i, &found, sizeof found);
  }
}

}  // namespace quadrille
