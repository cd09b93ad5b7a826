#include "patch_program.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "patch_program.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef QUADRILLE_PATCH_PROGRAM_ONCE
#define QUADRILLE_PATCH_PROGRAM_ONCE

namespace quadrille {

/// What is set up side by side, an element per patch.
constexpr int kProgramLanes = 16;
using ProgramLane = float[kProgramLanes];

/// Corner values of patches, positions relative to `center`, and their programs' numbers.
struct alignas(64) ProgramBatch {
  ProgramLane position[2][4], du[2][4], dv[2][4];
  ProgramLane color[4][4], color_dx[4][4], color_dy[4][4], color_twist[4][4], twist_sign[4];
  ProgramLane middle[2];     ///< of the patch relative to `center`
  ProgramLane linear[2][2];  ///< derivatives in the middle: [coordinate][parameter]
  ProgramLane higher[2][9], start[2][6], weights[4][16], newton_bound, color_bound;
  ProgramLane steepest;
  Eigen::Vector2d center[kProgramLanes];
};

}  // namespace quadrille

#endif

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, kProgramLanes>;
using V = hn::Vec<D>;

HWY_INLINE V load(const ProgramLane& lane, std::size_t i) { return hn::Load(D(), lane + i); }
HWY_INLINE void store(const V& v, ProgramLane& lane, std::size_t i) { hn::Store(v, D(), lane + i); }
HWY_INLINE V number(float x) { return hn::Set(D(), x); }

/// The cubic with values p0, p1 and derivatives d0, d1 at -1/2 and 1/2.
struct Cubic {
  V c[4];
};
HWY_INLINE Cubic cubic(const V& p0, const V& d0, const V& p1, const V& d1) {
  const V rise = p1 - p0, bend = d1 - d0, sum = d0 + d1;
  return {{(p0 + p1) * number(0.5f) - bend * number(0.125f),
           rise * number(1.5f) - sum * number(0.25f), bend * number(0.5f), sum - rise * number(2)}};
}

/// Weights of one coordinate of the Coons patch, from its corners.
struct Coons {
  V constant, s, t, higher[9];
};
HWY_INLINE Coons coons(const ProgramLane (&p)[4], const ProgramLane (&du)[4],
                       const ProgramLane (&dv)[4], std::size_t i) {
  const V p0 = load(p[0], i), p1 = load(p[1], i), p2 = load(p[2], i), p3 = load(p[3], i);
  const Cubic top = cubic(p0, load(du[0], i), p1, load(du[1], i));
  const Cubic bottom = cubic(p3, load(du[3], i), p2, load(du[2], i));
  const Cubic left = cubic(p0, load(dv[0], i), p3, load(dv[3], i));
  const Cubic right = cubic(p1, load(dv[1], i), p2, load(dv[2], i));
  const V half = number(0.5f);
  const auto mean = [&](int k) { return (top.c[k] + bottom.c[k]) * half; };
  const auto rise = [&](int k) { return bottom.c[k] - top.c[k]; };
  const auto mean_across = [&](int k) { return (left.c[k] + right.c[k]) * half; };
  const auto rise_across = [&](int k) { return right.c[k] - left.c[k]; };
  const V corners = ((p0 + p1) + (p2 + p3)) * number(0.25f);
  const V corners_s = ((p1 - p0) + (p2 - p3)) * half, corners_t = ((p3 - p0) + (p2 - p1)) * half;
  const V corners_st = (p2 - p3) - (p1 - p0);
  return {mean(0) + (mean_across(0) - corners),
          mean(1) + (rise_across(0) - corners_s),
          rise(0) + (mean_across(1) - corners_t),
          {mean(2), mean(3), rise(1) + (rise_across(1) - corners_st), rise(2), rise(3),
           mean_across(2), rise_across(2), mean_across(3), rise_across(3)}};
}

/// Position of parameters in normalized coordinates; d is the coordinate.
HWY_INLINE V position_at(const V (&q)[9], int d, const V& s, const V& t) {
  const V a = ((q[1] * s + q[0]) * s) + (d == 0 ? s : hn::Zero(D()));
  V b = ((q[4] * s + q[3]) * s + q[2]) * s;
  if (d == 1) b = b + number(1);
  const V c = q[6] * s + q[5], e = q[8] * s + q[7];
  return ((e * t + c) * t + b) * t + a;
}

/// Least squares over a 3 x 3 grid of parameters, by Cholesky's factorisation of the 6 x 6 normal
/// matrix.
HWY_INLINE void fit_start(const V (&q)[2][9], ProgramBatch& batch, std::size_t i) {
  V matrix[6][6], right[2][6];
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) matrix[r][c] = number(r == c ? 1e-6f : 0.0f);
    right[0][r] = right[1][r] = hn::Zero(D());
  }
  for (int sample = 0; sample < 9; ++sample) {
    // Chebyshev-like abscissae spread the error evenly over the square.
    constexpr float kAbscissae[3] = {-0.43f, 0, 0.43f};
    const V s = number(kAbscissae[sample % 3]), t = number(kAbscissae[sample / 3]);
    const V x = position_at(q[0], 0, s, t), y = position_at(q[1], 1, s, t);
    const V basis[6] = {number(1), x, y, x * x, x * y, y * y};
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c <= r; ++c) matrix[r][c] = matrix[r][c] + basis[r] * basis[c];
      right[0][r] = right[0][r] + s * basis[r];
      right[1][r] = right[1][r] + t * basis[r];
    }
  }
  V inverse_diagonal[6];
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) {
      V sum = matrix[r][c];
      for (int k = 0; k < c; ++k) sum = sum - matrix[r][k] * matrix[c][k];
      if (r == c) {
        inverse_diagonal[r] = number(1) / hn::Sqrt(hn::Max(sum, number(1e-7f)));
      } else {
        matrix[r][c] = sum * inverse_diagonal[c];
      }
    }
  }
  for (auto& b : right) {
    for (int r = 0; r < 6; ++r) {
      for (int k = 0; k < r; ++k) b[r] = b[r] - b[k] * matrix[r][k];
      b[r] = b[r] * inverse_diagonal[r];
    }
    for (int r = 5; r >= 0; --r) {
      for (int k = r + 1; k < 6; ++k) b[r] = b[r] - b[k] * matrix[k][r];
      b[r] = b[r] * inverse_diagonal[r];
    }
  }
  for (int d = 0; d < 2; ++d) {
    for (int r = 0; r < 6; ++r) store(right[d][r], batch.start[d][r], i);
  }
}

/// An upper bound of the Frobenius norm of the second derivatives for |s|, |t| <= 3/4: how far
/// apart Jacobians are at most, per distance.
HWY_INLINE V curvature_bound(const V (&q)[2][9]) {
  const V r = number(0.75f), two = number(2), six = number(6);
  V sum = hn::Zero(D());
  for (const auto& w : q) {
    const auto size = [&](int k) { return hn::Abs(w[k]); };
    const V ss = two * (size(0) + r * size(3)) + six * r * (size(1) + r * size(4));
    const V tt = two * (size(5) + r * size(6)) + six * r * (size(7) + r * size(8));
    const V st = size(2) + two * r * (size(3) + size(6)) + number(3) * r * r * (size(4) + size(8));
    sum = sum + (ss * ss + tt * tt + two * st * st);
  }
  return hn::Sqrt(sum);
}

/// Stores the weights of one channel; an upper bound of its gradient for |s|, |t| <= 0.55.
HWY_INLINE V set_channel(const ProgramLane (&value)[4], const V (&du)[4], const V (&dv)[4],
                         const V (&duv)[4], ProgramLane (&weights)[16], std::size_t i) {
  const Cubic rows[4] = {cubic(load(value[0], i), du[0], load(value[1], i), du[1]),
                         cubic(dv[0], duv[0], dv[1], duv[1]),
                         cubic(load(value[3], i), du[3], load(value[2], i), du[2]),
                         cubic(dv[3], duv[3], dv[2], duv[2])};
  V along_s = hn::Zero(D()), along_t = along_s;
  constexpr float kPower[4] = {1, 0.55f, 0.3025f, 0.166375f};
  for (int k = 0; k < 4; ++k) {
    const Cubic column = cubic(rows[0].c[k], rows[1].c[k], rows[2].c[k], rows[3].c[k]);
    for (int j = 0; j < 4; ++j) {
      store(column.c[j], weights[4 * j + k], i);
      const V size = hn::Abs(column.c[j]);
      if (k > 0) along_s = along_s + size * number(k * kPower[k - 1] * kPower[j]);
      if (j > 0) along_t = along_t + size * number(j * kPower[k] * kPower[j - 1]);
    }
  }
  return hn::Sqrt(along_s * along_s + along_t * along_t);
}

/// Weights of the colour; the bound of all channels.
HWY_INLINE V set_colors(const V (&twist)[2][4], bool opaque, ProgramBatch& batch, std::size_t i) {
  V length[4];  // |P_u| |P_v|, with the sign of the twist
  for (int k = 0; k < 4; ++k) {
    const V ux = load(batch.du[0][k], i), uy = load(batch.du[1][k], i);
    const V vx = load(batch.dv[0][k], i), vy = load(batch.dv[1][k], i);
    length[k] = hn::Sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy)) * load(batch.twist_sign[k], i);
  }
  V steepest = hn::Zero(D());
  for (int c = 0; c < (opaque ? 3 : 4); ++c) {
    V du[4], dv[4], duv[4];
    for (int k = 0; k < 4; ++k) {
      const V dx = load(batch.color_dx[c][k], i), dy = load(batch.color_dy[c][k], i);
      du[k] = dx * load(batch.du[0][k], i) + dy * load(batch.du[1][k], i);
      dv[k] = dx * load(batch.dv[0][k], i) + dy * load(batch.dv[1][k], i);
      duv[k] = dx * twist[0][k] + dy * twist[1][k] + load(batch.color_twist[c][k], i) * length[k];
    }
    steepest = hn::Max(steepest, set_channel(batch.color[c], du, dv, duv, batch.weights[c], i));
  }
  return steepest;
}

/// Adini's twists of one coordinate, see patch_geometry().
HWY_INLINE void adini_twists(const ProgramLane (&p)[4], const ProgramLane (&du)[4],
                             const ProgramLane (&dv)[4], std::size_t i, V (&twist)[4]) {
  const V mixed = (load(p[2], i) - load(p[3], i)) - (load(p[1], i) - load(p[0], i));
  const V rise_u[2] = {load(du[3], i) - load(du[0], i), load(du[2], i) - load(du[1], i)};
  const V rise_v[2] = {load(dv[1], i) - load(dv[0], i), load(dv[2], i) - load(dv[3], i)};
  twist[0] = rise_u[0] + rise_v[0] - mixed;
  twist[1] = rise_u[1] + rise_v[0] - mixed;
  twist[2] = rise_u[1] + rise_v[1] - mixed;
  twist[3] = rise_u[0] + rise_v[1] - mixed;
}

void set_up(ProgramBatch& batch, bool opaque) {
  for (std::size_t i = 0; i < kProgramLanes; i += hn::Lanes(D())) {
    Coons mesh[2];
    V twist[2][4];
    for (int d = 0; d < 2; ++d) {
      mesh[d] = coons(batch.position[d], batch.du[d], batch.dv[d], i);
      store(mesh[d].constant, batch.middle[d], i);
      store(mesh[d].s, batch.linear[d][0], i);
      store(mesh[d].t, batch.linear[d][1], i);
      adini_twists(batch.position[d], batch.du[d], batch.dv[d], i, twist[d]);
    }
    const V inverse = number(1) / (mesh[0].s * mesh[1].t - mesh[0].t * mesh[1].s);
    V q[2][9];
    for (int k = 0; k < 9; ++k) {
      const V x = mesh[0].higher[k], y = mesh[1].higher[k];
      q[0][k] = (mesh[1].t * x - mesh[0].t * y) * inverse;
      q[1][k] = (mesh[0].s * y - mesh[1].s * x) * inverse;
      for (int d = 0; d < 2; ++d) store(q[d][k], batch.higher[d][k], i);
    }
    fit_start(q, batch, i);
    const V curvature = curvature_bound(q);
    const V steepest = set_colors(twist, opaque, batch, i);
    store(steepest, batch.steepest, i);
    // Where 4 b curvature n <= 1, the root is at most 0.7 b curvature n^2 from the step's end.
    constexpr float kAllowed = 1.0f / 250 / 255;
    store(number(4) * curvature, batch.newton_bound, i);
    store(number(0.7f / kAllowed) * curvature * steepest, batch.color_bound, i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {

HWY_EXPORT(set_up);

void gather(const PatchMesh& patches, int q, int lane, ProgramBatch& batch) {
  const QuadMesh& mesh = patches.mesh;
  const auto& quad = mesh.quads()[q];
  const Eigen::Vector2d center = (mesh.vertices[quad[0]] + mesh.vertices[quad[1]] +
                                  mesh.vertices[quad[2]] + mesh.vertices[quad[3]]) /
                                 4;
  batch.center[lane] = center;
  for (int k = 0; k < 4; ++k) {
    const int h = 4 * q + k;
    const Eigen::Vector2d p = mesh.vertices[quad[k]] - center;
    // Sides 0 and 2 run along u, sides 1 and 3 along v; 2 and 3 against the parameter.
    auto& derivative = k % 2 == 0 ? batch.du : batch.dv;
    const Eigen::Vector2d begin = tangent_along(patches, h, 0), end = tangent_along(patches, h, 1);
    const Wedge& w = patches.wedges[patches.wedge_of_corner[h]];
    batch.twist_sign[k][lane] = static_cast<float>(twist_sign(mesh, h));
    for (int d = 0; d < 2; ++d) {
      batch.position[d][k][lane] = static_cast<float>(p[d]);
      derivative[d][k][lane] = static_cast<float>(k < 2 ? begin[d] : -begin[d]);
      derivative[d][(k + 1) % 4][lane] = static_cast<float>(k < 2 ? end[d] : -end[d]);
    }
    for (int c = 0; c < 4; ++c) {
      batch.color[c][k][lane] = w.value[c];
      batch.color_dx[c][k][lane] = w.dx[c];
      batch.color_dy[c][k][lane] = w.dy[c];
      batch.color_twist[c][k][lane] = w.twist[c];
    }
  }
}

void take(const ProgramBatch& batch, int lane, PatchProgram& program) {
  Eigen::Matrix2d linear;
  for (int d = 0; d < 2; ++d) {
    linear.row(d) << batch.linear[d][0][lane], batch.linear[d][1][lane];
    program.center[d] = batch.center[lane][d] + batch.middle[d][lane];
    for (int k = 0; k < 9; ++k) program.position[d][k] = batch.higher[d][k][lane];
    for (int k = 0; k < 6; ++k) program.start[d][k] = batch.start[d][k][lane];
  }
  for (int c = 0; c < 4; ++c) {
    for (int k = 0; k < 16; ++k) program.color[c][k] = batch.weights[c][k][lane];
  }
  program.newton_bound = batch.newton_bound[lane];
  program.color_bound = batch.color_bound[lane];
  program.steepest = batch.steepest[lane];
  const double determinant = linear.determinant();
  program.regular = determinant > 1e-5 * linear.col(0).norm() * linear.col(1).norm() &&
                    std::isfinite(program.newton_bound);
  if (program.regular) {
    program.to_normalized = linear.inverse();
  } else {
    program.to_normalized.setZero();
  }
}

}  // namespace

void make_programs(const PatchMesh& patches, std::span<const int> wanted, PatchProgram* programs) {
  ProgramBatch batch = {};
  const int count = static_cast<int>(wanted.size());
  for (int first = 0; first < count; first += kProgramLanes) {
    const int lanes = std::min(kProgramLanes, count - first);
    for (int i = 0; i < lanes; ++i) gather(patches, wanted[first + i], i, batch);
    HWY_DYNAMIC_DISPATCH(set_up)(batch, patches.opaque);
    for (int i = 0; i < lanes; ++i) take(batch, i, programs[first + i]);
  }
}

}  // namespace quadrille
#endif
