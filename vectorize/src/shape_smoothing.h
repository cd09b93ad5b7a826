#pragma once

#include <span>

#include "quadrille/quad_mesh.h"
#include "vertex_star.h"

namespace quadrille {

/// Moves the vertices of badly shaped quads along their guides (one per vertex) toward the least
/// shape energy of their star, see VertexStar, held back by a spring to where they were. A vertex
/// moves only if the smallest corner sine around it does not fall, so positive corners stay
/// positive. Well-shaped regions, and with them the alignment to features and the grading, are left
/// alone: a pass over all vertices costs more in the picture than it gains in shape.
void smooth_shape(QuadMesh& mesh, std::span<const VertexGuide> guides);

/// Takes feature edges off their features where a quad beside them has a corner below `least_sine`
/// that smoothing does not mend, round by round; what is left of the feature goes on beside the
/// gap.
void release_bad_features(QuadMesh& mesh, std::span<VertexGuide> guides, double least_sine);

}  // namespace quadrille
