#pragma once

#include <Eigen/Core>
#include <array>

#include "quadrille/bicubic.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// A rectangle of the parameter square of a patch.
struct ParameterBox {
  double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
};

/// A cubic Bezier curve in the plane.
using PlaneCurve = std::array<Eigen::Vector2d, 4>;

/// The geometry of a layer's patch in the coordinates of the picture.
BicubicHermite<Eigen::Vector2d> placed_geometry(const Layer& layer, int quad);

/// The edge of half-edge h in the coordinates of the picture, in its direction.
PlaneCurve edge_curve(const Layer& layer, int h);

/// The part of the curve from t0 to t1, 0 <= t0 <= t1 <= 1, as a curve of its own (blossom).
template <class T>
std::array<T, 4> sub_curve(const std::array<T, 4>& p, double t0, double t1) {
  using S = typename T::Scalar;
  const auto blossom = [&](double a, double b, double c) -> T {
    const auto mix = [](const T& x, const T& y, double t) -> T { return x * S(1 - t) + y * S(t); };
    const T ab = mix(p[0], p[1], a), bc = mix(p[1], p[2], a), cd = mix(p[2], p[3], a);
    return mix(mix(ab, bc, b), mix(bc, cd, b), c);
  };
  return {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1), blossom(t1, t1, t1)};
}

/// The part of a patch over the box, exactly.
template <class T>
BicubicBezier<T> sub_patch(const BicubicBezier<T>& patch, const ParameterBox& box) {
  BicubicBezier<T> part;
  for (int j = 0; j < 4; ++j) part.control[j] = sub_curve(patch.control[j], box.u0, box.u1);
  for (int i = 0; i < 4; ++i) {
    const std::array<T, 4> column =
        sub_curve(std::array<T, 4>{part.control[0][i], part.control[1][i], part.control[2][i],
                                   part.control[3][i]},
                  box.v0, box.v1);
    for (int j = 0; j < 4; ++j) part.control[j][i] = column[j];
  }
  return part;
}

/// Side k of a patch (0: v = 0, 1: u = 1, 2: v = 1, 3: u = 0) from corner k to corner k + 1.
PlaneCurve side_curve(const BicubicBezier<Eigen::Vector2d>& patch, int side);

/// An upper bound of the distance between the curve and its chord, in the curve's units.
double chord_distance(const PlaneCurve& curve);

struct Divisions {
  int u = 1, v = 1;
};

/// About the fewest equal parts, at most 4 per direction, with which bilinear interpolation of the
/// parts' corner colours stays near the patch's colour, clamped to [0, 1]: within half of
/// `tolerance` in the root mean square and within twice of it anywhere. 4 x 4 where none do.
Divisions bilinear_divisions(const BicubicBezier<Color>& color, double tolerance);

}  // namespace quadrille
