#pragma once

#include <Eigen/Core>
#include <vector>

#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"

namespace quadrille {

/// The paper's colours (section 4.1): the picture sampled at each vertex, derivatives along the
/// edges by the Bessel scheme. Departure: per wedge the derivatives are replaced by the gradient
/// that explains them best, which the paper's valence-4 vertices do not need. Twists are zero. Runs
/// in the caller's tbb arena.
std::vector<Wedge> bessel_wedges(const PatchMesh& patches, const Raster& picture);

/// How much one sample adds to a wedge's value, dx and dy.
struct BesselTerm {
  int sample;  ///< of wedge number `sample`
  Eigen::Vector3f factors;
};

/// The same scheme as a linear map: the terms of each wedge, ascending, over one sample per wedge.
std::vector<std::vector<BesselTerm>> bessel_terms(const PatchMesh& patches);

}  // namespace quadrille
