#pragma once

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Moves vertices of badly shaped quads toward the mean of their neighbours where, and as far as,
/// the smallest corner sine of the quads around them grows; border vertices slide along their side
/// of the picture and are fixed elsewhere. Positive corners stay positive. Well-shaped regions, and
/// with them the alignment to features, are left alone.
void smooth_bad_quads(QuadMesh& mesh, double width, double height);

}  // namespace quadrille
