#pragma once

#include <cmath>

#include "quadrille/vector_image.h"

namespace quadrille::testing {

/// Whether every number of the image is finite.
inline bool is_finite(const VectorImage& image) {
  bool finite = std::isfinite(image.width) && std::isfinite(image.height);
  for (const Layer& layer : image.layers) {
    finite = finite && layer.transform.matrix().allFinite();
    for (const Eigen::Vector2d& p : layer.patches.mesh.vertices) finite = finite && p.allFinite();
    for (const auto& tangents : layer.patches.edge_tangents) {
      for (const Eigen::Vector2d& t : tangents) finite = finite && t.allFinite();
    }
    for (const Wedge& w : layer.patches.wedges) {
      for (const Color& c : {w.value, w.dx, w.dy, w.twist}) finite = finite && c.isFinite().all();
    }
  }
  return finite;
}

}  // namespace quadrille::testing
