#pragma once

#include <Eigen/Geometry>

#include "quadrille/scene_layer.h"

namespace quadrille::viewer {

/// What of some shapes is shown, in window pixels: at any zoom the numbers stay small enough for
/// the graphics card's single precision.
struct WindowShapes {
  struct Line {
    int cell = 0;
    std::vector<Eigen::Vector2d> points;  ///< two or more
  };
  std::vector<Line> lines;
  std::vector<std::pair<int, Eigen::Vector2d>> points;  ///< index and place
};

/// Polylines, polygons' outlines (a side that several share once) and points, placed by
/// p -> scale p + origin and cut off at the box.
WindowShapes clip_shapes(const SceneShapes& shapes, const Eigen::Array2d& scale,
                         const Eigen::Array2d& origin, const Eigen::AlignedBox2d& box);

/// The part of a segment within a box (Liang, Barsky 1984), or false when there is none.
bool clip_segment(const Eigen::AlignedBox2d& box, Eigen::Vector2d& a, Eigen::Vector2d& b);

}  // namespace quadrille::viewer
