#pragma once

#include "quadrille/cross_field.h"

namespace quadrille {

struct LocalSmoothingOptions {
  /// Weight of the feature direction beside a neighbour's weight of 1 (> 0), as
  /// CrossFieldOptions::alignment.
  double alignment = 0.05;
  int sweeps = 6;  ///< over each level
  /// Start on a coarse grid and refine, each pixel from four; else on the pixels alone.
  bool hierarchical = true;
};

/// The cross field as Instant Meshes computes it (Jakob et al. 2015, section 3.3), for comparison:
/// Gauss-Seidel sweeps over unit vectors, each becoming the mean of its neighbours and of the
/// feature direction, each turned by the multiple of 90 degrees that matches best. The data is that
/// of cross_field().
CrossField local_angle_smoothing(const FeatureTensor& features,
                                 const LocalSmoothingOptions& options = {},
                                 const RunContext& context = {});

}  // namespace quadrille
