#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bitset>

#include "svg_gradient.h"

namespace quadrille {

/// Least squares for functions of the picture that change along one direction only, or sums of two
/// such functions: piecewise linear between evenly spaced stops.

/// The vector of a gradient as the samples see it.
struct RidgeAxis {
  GradientVector vector;
  std::array<double, CellSamples::kMost> place{};  ///< 0 at the first stop, 1 at the last
};

/// Directions that many cells have in common: (cos, sin) of pi d / kCommonDirections in the unit
/// square. The ends of their vectors are at multiples of an eighth of the square's extent.
inline constexpr int kCommonDirections = 8;
RidgeAxis common_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, int direction);

/// An axis at any angle in the unit square, from the first of the samples along it to the last.
RidgeAxis own_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double angle);

/// The angle in the unit square at which the samples' colours change most.
double steepest_angle(const CellSamples& samples, const Eigen::AlignedBox2d& bounds);

struct RidgePlace {
  int interval;
  double fraction;
};
inline RidgePlace ridge_place(double place, int stops) {
  const double x = std::min(std::max(0.0, place * (stops - 1)), stops - 1.0);
  const int k = std::min(static_cast<int>(x), stops - 2);
  return {k, x - k};
}

/// Per sample its colour times its weight, and the weight.
struct WeightedColors {
  int count;
  std::array<Eigen::Array4d, CellSamples::kMost> sample;
  explicit WeightedColors(const CellSamples& samples);
};

/// The normal equations of the stop colours along one axis.
struct RidgeSystem {
  static constexpr int kSize = LinearGradient::kMaxStops;
  int stops = 0;
  /// Per stop the three channels of the right-hand side, and the diagonal of the matrix, which is
  /// tridiagonal; then what lies below its diagonal.
  std::array<Eigen::Array4d, kSize> right_and_diagonal;
  std::array<double, kSize> below{};
  std::array<RidgePlace, CellSamples::kMost> place;

  RidgeSystem() = default;
  RidgeSystem(const WeightedColors& colors, const RidgeAxis& axis, int stop_count);
};

template <int Size>
struct RidgeSolution {
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, Size, 3> stops;  ///< one row per stop
  std::bitset<Size> left_out;  ///< stops that lie on the line between their neighbours
  double explained = 0;  ///< by how much the weighted squares of the colours fall, all channels
};

RidgeSolution<RidgeSystem::kSize> solve_ridge(const RidgeSystem& system);

/// The stops of the first summand, then those of the second.
RidgeSolution<2 * RidgeSystem::kSize> solve_ridges(const WeightedColors& colors,
                                                   const RidgeSystem& a, const RidgeSystem& b);

/// Solutions in which stops are left out, one after the other, the least important first, as long
/// as `explained` falls by less than `worth` with it. The others, and the stops at the ends, are at
/// the best that remains.
RidgeSolution<RidgeSystem::kSize> thinned_ridge(const RidgeSystem& system, double worth);
RidgeSolution<2 * RidgeSystem::kSize> thinned_ridges(const WeightedColors& colors,
                                                     const RidgeSystem& a, const RidgeSystem& b,
                                                     double worth);

}  // namespace quadrille
