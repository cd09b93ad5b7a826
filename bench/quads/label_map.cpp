#include "label_map.h"

#include <algorithm>
#include <cmath>

namespace quadrille::bench {
namespace {

// A centre that lies on a side goes to the cell on its left or above, as a line there would.
constexpr double kCentre = 0.5 - 1e-6;

/// Whether p lies in the convex quad, its sides included.
bool holds(const QuadMesh& mesh, int quad, const Eigen::Vector2d& p) {
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d& a = mesh.vertices[mesh.origin(4 * quad + k)];
    const Eigen::Vector2d side = mesh.vertices[mesh.tip(4 * quad + k)] - a, to_p = p - a;
    if (side.x() * to_p.y() - side.y() * to_p.x() < 0) return false;
  }
  return true;
}

}  // namespace

LabelMap quad_labels(const QuadMesh& mesh, int width, int height) {
  LabelMap labels(width, height);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    Eigen::Vector2d low = mesh.vertices[mesh.origin(4 * q)], high = low;
    for (int k = 1; k < 4; ++k) {
      low = low.cwiseMin(mesh.vertices[mesh.origin(4 * q + k)]);
      high = high.cwiseMax(mesh.vertices[mesh.origin(4 * q + k)]);
    }
    const int x_end = std::min(width - 1, static_cast<int>(high.x()));
    const int y_end = std::min(height - 1, static_cast<int>(high.y()));
    for (int y = std::max(0, static_cast<int>(low.y())); y <= y_end; ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x <= x_end; ++x) {
        if (holds(mesh, q, {x + kCentre, y + kCentre})) labels(x, y) = q;
      }
    }
  }
  return labels;
}

BoundaryMask boundary_of(const LabelMap& labels) {
  const int w = labels.width, h = labels.height;
  BoundaryMask boundary{w, h, std::vector<unsigned char>(labels.label.size(), 0)};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool right = x + 1 < w && labels(x, y) != labels(x + 1, y);
      const bool below = y + 1 < h && labels(x, y) != labels(x, y + 1);
      boundary.marked[static_cast<std::size_t>(y) * w + x] = right || below;
    }
  }
  return boundary;
}

}  // namespace quadrille::bench
