#pragma once

#include <Eigen/Core>
#include <array>

#include "svg_gradient.h"

namespace quadrille {

/// Least squares for functions of the picture that change along one direction only, or sums of two
/// such functions: piecewise linear between evenly spaced stops.

/// The vector of a gradient as the samples see it.
struct RidgeAxis {
  GradientVector vector;
  std::array<double, CellSamples::kCount> place{};  ///< 0 at the first stop, 1 at the last
};

/// Directions that many cells have in common: (cos, sin) of pi d / kCommonDirections in the unit
/// square. The ends of their vectors are at multiples of an eighth of the square's extent.
inline constexpr int kCommonDirections = 8;
RidgeAxis common_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, int direction);

/// An axis at any angle in the unit square, from the first of the samples along it to the last but
/// for shares of that extent at its ends, where the first and the last stop's colours go on.
struct AxisRange {
  double angle = 0;
  double before = 0, after = 0;
};
RidgeAxis own_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds,
                   const AxisRange& range);

/// The angle in the unit square at which the samples' colours change most.
double steepest_angle(const CellSamples& samples, const Eigen::AlignedBox2d& bounds);

struct RidgePlace {
  int interval;
  double fraction;
};
inline RidgePlace ridge_place(double place, int stops) {
  const double x = place * (stops - 1);
  const int k = x <= 0 ? 0 : x >= stops - 1 ? stops - 2 : static_cast<int>(x);
  return {k, x - k < 0 ? 0 : x - k > 1 ? 1 : x - k};
}

/// The normal equations of the stop colours along one axis.
struct RidgeSystem {
  static constexpr int kSize = LinearGradient::kMaxStops;
  int stops = 0;
  std::array<double, kSize> diagonal{}, below{};  ///< of the matrix, which is tridiagonal
  std::array<std::array<double, 3>, kSize> right{};
  std::array<RidgePlace, CellSamples::kCount> place;

  RidgeSystem() = default;
  RidgeSystem(const CellSamples& samples, const RidgeAxis& axis, int stop_count);
};

template <int Size>
struct RidgeSolution {
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, Size, 3> stops;  ///< one row per stop
  double explained = 0;  ///< by how much the weighted squares of the colours fall, all channels
};

RidgeSolution<RidgeSystem::kSize> solve_ridge(const RidgeSystem& system);

/// The stops of the first summand, then those of the second.
RidgeSolution<2 * RidgeSystem::kSize> solve_ridges(const CellSamples& samples, const RidgeSystem& a,
                                                   const RidgeSystem& b);

}  // namespace quadrille
