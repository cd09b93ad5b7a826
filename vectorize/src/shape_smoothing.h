#pragma once

#include <span>
#include <vector>

#include "quadrille/quad_mesh.h"
#include "vertex_star.h"

namespace quadrille {

/// The smallest corner sine above which a vertex is well-shaped.
inline constexpr double kGoodSine = 0.7;

/// The quads around a vertex as its star in which it can be moved.
void collect_star(const QuadMesh& mesh, int v, std::vector<StarWedge>& wedges);

/// Moves the vertices of badly shaped quads along their guides (one per vertex) toward the least
/// shape energy of their star, see VertexStar, held back by a spring to where they were. A vertex
/// moves only if the smallest corner sine around it does not fall, so positive corners stay
/// positive. Well-shaped regions, and with them the alignment to features and the grading, are left
/// alone: a pass over all vertices costs more in the picture than it gains in shape.
void smooth_shape(QuadMesh& mesh, std::span<const VertexGuide> guides);

}  // namespace quadrille
