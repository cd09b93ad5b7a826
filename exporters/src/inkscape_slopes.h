#pragma once

#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Colours along a line of the nodes of a bicubic mesh gradient, as Inkscape interpolates them: by
/// cubics between nodes, whose slopes are the means of the chords' slopes, per pixel of straight
/// distance, limited to 3 times each and zero at extremes; at both ends such that the curve is a
/// parabola.
class NodeLine {
 public:
  void add(const Eigen::Vector2d& position, const Color& color);
  /// Of the nodes, at least 2, per pixel.
  std::vector<Color> slopes() const;
  /// The colour at t in [0, 1] between node i and the next.
  Color between(std::size_t i, double t, const std::vector<Color>& slopes) const;

 private:
  std::vector<Eigen::Vector2d> positions_;
  std::vector<Color> colors_;
  std::vector<float> lengths_;  ///< from each node to the next

  Color chord_slope(std::size_t i) const;
  Color inner_slope(std::size_t i) const;
};

}  // namespace quadrille
