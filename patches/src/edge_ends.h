#pragma once

#include <vector>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// The two ends of edge e are numbered 2 e (the origin of mesh.halfedge(e)) and 2 e + 1 (its tip).
/// The other end of the same edge is end ^ 1.
inline int edge_end(const QuadMesh& mesh, int h, int at) {
  const int e = mesh.edge(h);
  return 2 * e + (mesh.halfedge(e) == h ? at : 1 - at);
}

inline int vertex_at(const QuadMesh& mesh, int end) {
  const int h = mesh.halfedge(end >> 1);
  return (end & 1) ? mesh.tip(h) : mesh.origin(h);
}

/// For every edge end the end of another edge at the same vertex that continues the curve there, or
/// -1: the rule stands at set_bessel_tangents().
std::vector<int> opposite_ends(const QuadMesh& mesh);

}  // namespace quadrille
