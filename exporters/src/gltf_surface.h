#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gltf_divisions.h"
#include "quadrille/run_context.h"
#include "sheeted_layer.h"

namespace quadrille {

/// Triangles of one sheet, counter-clockwise; 1 unit = 1 pixel of the picture, x to the right, y
/// up, the picture's bottom left corner at the origin, z towards the viewer.
struct SurfacePart {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;  ///< unit length; empty unless asked for
  /// Straight (not multiplied by alpha), in linear light; empty unless asked for.
  std::vector<std::array<float, 4>> colors;
  /// 3 per triangle. Consecutive triangles that start with the same vertex are one polygon
  /// (FB_ngon_encoding).
  std::vector<std::uint32_t> indices;
};

/// Divides and triangulates the drawn patches; returns a part per sheet. Each edge is divided once
/// and both patches beside it use the same places, so there are no T-junctions; they use the same
/// vertices too, but along tears and where sheets meet. With relief z is the luma (Rec. 709) times
/// its height, at a tear the mean of both sides': the surface stays closed.
std::vector<SurfacePart> make_surface(const SheetedLayer& layer, double picture_height,
                                      const SurfaceContent& content, const RunContext& context);

}  // namespace quadrille
