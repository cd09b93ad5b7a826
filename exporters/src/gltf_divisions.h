#pragma once

#include <array>
#include <vector>

#include "quadrille/run_context.h"
#include "sheeted_layer.h"

namespace quadrille {

/// Largest distance in pixels between the curve of an edge and the segments that stand for it: on
/// the outline and along tears, and elsewhere. There it can be coarser where a planar texture has
/// the colours, since the triangles show in a wire frame only.
inline constexpr double kContourTolerance = 0.05;
inline constexpr double kInnerTolerance = 0.125;
inline constexpr double kTexturedTolerance = 0.5;
/// Largest error of heights in pixels, but for that of the at most 16 parts per side of a patch.
inline constexpr double kHeightTolerance = 0.25;
/// Largest error of colours between vertices, of 1, likewise.
inline constexpr double kColorTolerance = 2.0 / 255;

/// What the vertices carry besides their place in the plane.
struct SurfaceContent {
  bool has_colors = false;
  bool has_normals = false;
  double relief = 0;  ///< height of white in pixels
};

/// Into how many parts edges and patches are divided, uniformly in their parameters.
struct SurfaceDivisions {
  std::vector<int> edges;                   ///< #E; both patches beside an edge share it
  std::vector<std::array<int, 2>> patches;  ///< #Q, along u and v, at least those of the sides
};

/// As coarse as the tolerances allow, and so that no triangle of a patch that does not fold faces
/// away: the chords of a coarsely divided edge may cut through what lies beside it. Throws
/// Error{limit_exceeded} when that takes more than 2^26 cells.
SurfaceDivisions divide(const SheetedLayer& layer, const SurfaceContent& content,
                        const RunContext& context);

}  // namespace quadrille
