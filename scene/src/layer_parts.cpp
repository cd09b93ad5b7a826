#include "layer_parts.h"

#include "quadrille/bicubic.h"

namespace quadrille {

Eigen::Vector2d edge_point(const PatchMesh& patches, int e, double t) {
  const QuadMesh& mesh = patches.mesh;
  const int h = mesh.halfedge(e);
  const auto& [start, end] = patches.edge_tangents[e];
  const auto basis = hermite_basis(t);
  return basis[0] * mesh.vertices[mesh.origin(h)] + basis[1] * start +
         basis[2] * mesh.vertices[mesh.tip(h)] + basis[3] * end;
}

}  // namespace quadrille
