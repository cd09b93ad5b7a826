#include "svg_slope.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace quadrille {

Eigen::Matrix<double, 3, 2> paint_slopes(const BicubicHermite<Eigen::Vector2d>& position,
                                         const BicubicHermite<Color>& color, CellPaint paint,
                                         double u, double v) {
  constexpr double kSteepest = 255;
  Eigen::Matrix2d jacobian;
  jacobian << position.derivative_u(u, v), position.derivative_v(u, v);
  if (std::abs(jacobian.determinant()) < 1e-9) return Eigen::Matrix<double, 3, 2>::Zero();
  const Color c = color.at(u, v), cu = color.derivative_u(u, v), cv = color.derivative_v(u, v);
  const double straight = 1 / std::max(std::clamp(double(c[3]), 0.0, 1.0), 1e-3);
  Eigen::Matrix<double, 3, 2> by_parameters;
  for (int k = 0; k < 3; ++k) {
    if (paint == CellPaint::alpha) {
      by_parameters.row(k) << cu[3], cv[3];
    } else {
      const double level = c[k] * straight;
      by_parameters.row(k) << straight * (cu[k] - level * cu[3]),
          straight * (cv[k] - level * cv[3]);
    }
  }
  Eigen::Matrix<double, 3, 2> slopes = 255 * by_parameters * jacobian.inverse();
  for (int k = 0; k < 3; ++k) {
    slopes.row(k) *= std::min(1.0, kSteepest / std::max(slopes.row(k).norm(), 1e-9));
  }
  return slopes;
}

}  // namespace quadrille
