#pragma once

#include "quadrille/vectorize.h"

namespace quadrille {

struct FittedPatches {
  PatchMesh patches;
  FitReport fit;             ///< of the colours on the picture
  OptimizeReport optimized;  ///< of the vertices, on the picture or the reduced one
};

/// fit_patches() and optimize_vertices(), the latter from sampled colours. Where patches have many
/// more pixels than it takes to place their vertices, these are moved on a reduced picture, at a
/// fraction of the time; the colours are those that fit the picture best in any case. `picture`
/// contains the mesh.
FittedPatches fitted_patches(QuadMesh mesh, const Raster& picture, const FitOptions& fit,
                             const OptimizeOptions& optimize, const RunContext& context);

}  // namespace quadrille
