#pragma once

#include <array>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// The control points of a layer's patches, in the numbering of VTK_BEZIER_QUADRILATERAL.
struct ControlPoints {
  std::vector<Eigen::Vector2d> position;  ///< y up, the picture's bottom left corner at the origin
  std::vector<Color> color;               ///< premultiplied
  std::vector<std::array<int, 16>> cells;
};

/// Neighbours share the control points of their common edge (they are equal to the last bit), so
/// that VTK sees one connected surface; where colours jump at a tear, each side has its own.
///
/// y up turns patches around, so the cell's first parameter is the patch's v and its second u:
/// cells are counter-clockwise. In a layer whose transform mirrors, the first is u and the second
/// v.
ControlPoints control_points(const Layer& layer, double picture_height);

}  // namespace quadrille
