#pragma once

#include <Eigen/Core>
#include <array>

#include "svg_gradient.h"

namespace quadrille {

/// Least squares for functions of the picture that change along one direction only, or sums of two
/// such functions: piecewise linear between evenly spaced stops.

/// A direction of gradients as the samples see it.
struct RidgeAxis {
  int first = 0, last = 0;                          ///< see LinearGradient
  std::array<double, CellSamples::kCount> place{};  ///< 0 at the first stop, 1 at the last
};
RidgeAxis ridge_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, int direction);

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
  Eigen::Matrix<double, kSize, kSize> matrix;  ///< the top left corner counts
  Eigen::Matrix<double, kSize, 3> right;
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
