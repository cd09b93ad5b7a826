#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>

namespace quadrille {

/// The vector of a linear gradient: its ends in the unit square that the bounds of what is painted
/// are scaled to (objectBoundingBox); own ones in decimals as they are written.
struct GradientVector {
  Eigen::Vector2d from = {0, 0}, to = {1, 0};
  bool is_common = true;  ///< of the few directions and ranges that serve most cells
};

/// A linear gradient whose stops rise from 0 to 1.
struct LinearGradient {
  static constexpr int kMaxStops = 8;
  using Rgb = std::array<std::uint8_t, 3>;
  struct Stop {
    double offset = 0;
    Rgb color{};
  };

  GradientVector vector;
  int stop_count = 1;  ///< 1 means one flat colour
  std::array<Stop, kMaxStops> stops{};
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
  static constexpr int kMostAlong = 10;  ///< a side of the grid
  static constexpr int kMost = kMostAlong * kMostAlong;

  int count = 0;  ///< of those that follow
  std::array<Eigen::Vector2d, kMost> position;
  std::array<Eigen::Array3d, kMost> color;  ///< 0 to 255
  std::array<double, kMost> weight;  ///< square pixels that the sample stands for, times its alpha
  /// The structure tensor: weighted sum of g g' over the samples and channels, g the gradient of
  /// the colour in the picture.
  Eigen::Matrix2d slopes = Eigen::Matrix2d::Zero();
  /// Whether the edge of the paint shows along some side. A second gradient would cover more of its
  /// half-covered pixels than the first.
  bool is_cut = false;
};

struct CellFit {
  CellFill fill;
  double squared_error = 0;  ///< over the cell's square pixels, mean of the channels, 8-bit steps
  double bytes = 0;          ///< about what the fill takes in a compressed file, and in time
  double cost(double price) const { return squared_error + price * bytes; }
};

/// About the fill with the lowest cost where a byte of a compressed file costs `price`. The bounds
/// are those of what will be painted; `again` is what painting the outline once more takes, in
/// bytes; where the cell is cut that is not done. Stop colours minimise the squared error. A fill
/// that costs more than `limit` need not be the best.
CellFit fit_cell(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double price,
                 double again, double limit = std::numeric_limits<double>::max());

}  // namespace quadrille
