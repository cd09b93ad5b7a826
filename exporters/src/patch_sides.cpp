#include "patch_sides.h"

#include <cmath>

namespace quadrille {

using Eigen::Vector2d;

Vector2d on_side(int k, double s, double depth) {
  switch (k) {
    case 0:
      return {s, depth};
    case 1:
      return {1 - depth, s};
    case 2:
      return {1 - s, 1 - depth};
    default:
      return {depth, 1 - s};
  }
}

double parameter_step(const BicubicHermite<Vector2d>& g, const Vector2d& uv, bool along_u,
                      double distance) {
  constexpr double kDeepest = 0.5, kLongest = 3;
  const Vector2d du = g.derivative_u(uv.x(), uv.y()), dv = g.derivative_v(uv.x(), uv.y());
  const double area = std::abs(du.x() * dv.y() - du.y() * dv.x());
  const double own = along_u ? du.norm() : dv.norm(), other = along_u ? dv.norm() : du.norm();
  const double depth = area * kDeepest > distance * other ? distance * other / area : kDeepest;
  return depth * own > kLongest * distance ? kLongest * distance / own : depth;
}

Vector2d inside(const BicubicHermite<Vector2d>& g, int k, double s, double distance) {
  const double depth = parameter_step(g, on_side(k, s), k == 1 || k == 3, distance);
  const Vector2d uv = on_side(k, s, depth);
  return g.at(uv.x(), uv.y());
}

}  // namespace quadrille
