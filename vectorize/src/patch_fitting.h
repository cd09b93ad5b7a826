#pragma once

#include "quadrille/vectorize.h"

namespace quadrille {

struct FittedPatches {
  PatchMesh patches;
  FitReport fit;  ///< on the mesh before its vertices were optimised, rough then
  OptimizeReport optimized;
};

/// fit_patches() and optimize_vertices(). Where patches have many more pixels than it takes to
/// place their vertices, these are moved on a reduced picture, at a fraction of the time; the
/// colours are those that fit the picture best in any case.
FittedPatches fitted_patches(QuadMesh mesh, const Raster& picture, const FitOptions& fit,
                             const OptimizeOptions& optimize, const RunContext& context);

}  // namespace quadrille
