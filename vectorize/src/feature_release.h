#pragma once

#include <span>

#include "quadrille/quad_mesh.h"
#include "vertex_star.h"

namespace quadrille {

/// Takes feature edges off their features where a quad beside them has a corner below `least_sine`
/// that smoothing does not mend, round by round; what is left of the feature goes on beside the
/// gap. Quads that stay bad are spread over the place of their neighbours and smoothed again.
void release_bad_features(QuadMesh& mesh, std::span<VertexGuide> guides, double least_sine);

}  // namespace quadrille
