#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>

namespace quadrille {

/// A linear gradient with evenly spaced stops. Directions and places are those of the unit square
/// that the bounds of what is painted are scaled to (objectBoundingBox): a few directions and
/// ranges then serve all cells.
struct LinearGradient {
  static constexpr int kMaxStops = 8;
  static constexpr int kDirections = 8;  ///< direction d: (cos, sin) of pi d / 8
  static constexpr int kPlaces = 8;  ///< places are multiples of 1 / kPlaces of the square's extent
  using Rgb = std::array<std::uint8_t, 3>;

  int direction = 0;
  int first = 0, last = kPlaces;  ///< where the first and the last stop lie
  int stop_count = 1;             ///< 1 means one flat colour
  std::array<Rgb, kMaxStops> stops{};
};

/// The nearest 8-bit colour to one of 0 to 255.
LinearGradient::Rgb rounded_color(const Eigen::Array3d& color);

/// What fills a cell: a gradient, and over it perhaps a second one in another direction that lets
/// the first one through. Both together show any sum of a function along the one direction and a
/// function along the other: colours whose channels change in different directions, which one
/// gradient cannot.
struct CellFill {
  LinearGradient base, overlay;
  double overlay_opacity = 0;  ///< 0 without overlay
};

/// Colours of a cell on a grid of its parameters, the borders included.
struct CellSamples {
  static constexpr int kSide = 10;
  static constexpr int kCount = kSide * kSide;

  std::array<Eigen::Vector2d, kCount> position;
  std::array<Eigen::Array3d, kCount> color;  ///< 0 to 255
  std::array<double, kCount> weight;  ///< square pixels that the sample stands for, times its alpha
};

struct CellFit {
  CellFill fill;
  double squared_error = 0;  ///< over the cell's square pixels, mean of the channels, 8-bit steps
  double bytes = 0;          ///< about what the fill takes in a compressed file
  double cost(double price) const { return squared_error + price * bytes; }
};

/// About the fill with the lowest cost where a byte of a compressed file costs `price`. The bounds
/// are those of what will be painted; `again` is what painting the outline once more takes, in
/// bytes. Stop colours minimise the squared error. A fill that costs more than `limit` need not be
/// the best.
CellFit fit_cell(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double price,
                 double again, double limit = std::numeric_limits<double>::max());

}  // namespace quadrille
