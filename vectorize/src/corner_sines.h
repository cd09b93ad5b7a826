#pragma once

#include <algorithm>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// The smallest scaled Jacobian of the quads at v.
inline double smallest_sine_around(const QuadMesh& mesh, int v) {
  double smallest = 1;
  for (const int h : mesh.fan(v)) {
    smallest = std::min(smallest, scaled_jacobian(mesh, QuadMesh::quad_of(h)));
  }
  return smallest;
}

}  // namespace quadrille
