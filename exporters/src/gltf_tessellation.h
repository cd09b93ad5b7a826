#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// Counter-clockwise triangles with shared vertices; 1 unit = 1 pixel of the picture, x to the
/// right, y up, the picture's bottom left corner at the origin.
struct TriangleMesh {
  std::vector<std::array<float, 2>> positions;
  std::vector<std::uint32_t> indices;  ///< 3 per triangle
};

/// Largest distance in pixels between an edge curve and the segments that stand for it, on the
/// outline. Inside it can be coarser: the picture comes from a planar texture, so there the
/// triangles show in a wire frame only.
inline constexpr double kOutlineTolerance = 0.1;
inline constexpr double kInnerTolerance = 0.25;

/// Triangulates all patches of a layer. Each mesh edge is divided once, by its own curvature, and
/// both patches beside it use the same vertices, so there are no T-junctions. Patches without
/// curved edges become two triangles.
TriangleMesh tessellate(const Layer& layer, double picture_height);

}  // namespace quadrille
