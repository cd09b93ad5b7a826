#pragma once

#include <vector>

#include "grid_decomposition.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// The patches of a grid in the picture's coordinates, all seen alike: u runs to the right in the
/// grid and v down.
class PlacedGrid {
 public:
  PlacedGrid(const Layer& layer, const QuadGrid& grid);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const BicubicBezier<Eigen::Vector2d>& position(int column, int row) const {
    return positions_[row * columns_ + column];
  }
  const BicubicBezier<Color>& color(int column, int row) const {
    return colors_[row * columns_ + column];
  }

 private:
  int columns_, rows_;
  std::vector<BicubicBezier<Eigen::Vector2d>> positions_;
  std::vector<BicubicBezier<Color>> colors_;
};

}  // namespace quadrille
