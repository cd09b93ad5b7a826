#pragma once

#include "quadrille/quad_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

struct SnapOptions {
  int rounds = 6;  ///< 0 leaves the mesh alone
  /// Smallest corner sine that moves may leave behind, in (0, 1); worse corners do not get worse.
  double min_corner_sine = 0.45;
};

/// Moves vertices so that the edges of the mesh lie on the colour edges of the picture, at its full
/// resolution. Every mesh edge parts two quads with mean colours c and d; seen along its normal,
/// the split that costs least when the pixels on one side take c and those on the other d (the
/// two-phase model of Chan and Vese, Active contours without edges, 2001) is where it belongs. Each
/// vertex takes the least-squares step toward the splits of its edges, weighted by their contrast.
/// Connectivity stays, and so do the vertices of feature edges; border vertices slide along
/// straight axis-parallel borders and stay where the border bends or runs obliquely. The mesh lies
/// within the picture; source pixels. The same bits for any thread count. Throws
/// Error{invalid_argument} for options outside their ranges.
void snap_to_features(QuadMesh& mesh, const Raster& picture, const SnapOptions& options = {},
                      const RunContext& context = {});

}  // namespace quadrille
