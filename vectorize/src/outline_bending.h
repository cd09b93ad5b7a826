#pragma once

#include "outline_sampling.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Moves the vertices in the middle of the outline's edges from their chords to the outline's
/// midpoints, as far as the quads there keep sound corners. The edges are found by the positions of
/// their ends.
void bend_outline(QuadMesh& mesh, const OutlineSamples& outline);

}  // namespace quadrille
