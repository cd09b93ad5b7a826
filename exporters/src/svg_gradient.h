#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace quadrille {

/// What fills a cell: one colour, or a linear gradient with evenly spaced stops.
struct GradientFill {
  static constexpr int kMaxStops = 8;
  using Rgb = std::array<std::uint8_t, 3>;

  Eigen::Vector2d from = {0, 0}, to = {0, 0};  ///< where the first and the last stop lie, in pixels
  std::array<Rgb, kMaxStops> stops{};
  int stop_count = 1;  ///< 1 means one flat colour
};

/// Colours of a cell on a grid of its parameters, the borders included.
struct CellSamples {
  static constexpr int kSide = 10;
  static constexpr int kCount = kSide * kSide;

  std::array<Eigen::Vector2d, kCount> position;
  std::array<Eigen::Array3f, kCount> color;  ///< 0 to 255
  std::array<float, kCount> weight;          ///< how much an error counts, 0 to 1
};

struct GradientFit {
  GradientFill fill;
  /// In 8-bit steps: twice the root mean square of the weighted differences at the samples, or half
  /// of the largest one if that is more. A difference is itself the root mean square over R, G, B.
  double error = 0;
};

/// The fill with the fewest stops whose error is within the tolerance; when there is none, about
/// the best fill that there is. Stop colours minimise the squared error for their direction.
GradientFit fit_gradient(const CellSamples& samples, double tolerance);

}  // namespace quadrille
