#include "pick.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "quadrille/patch_mesh.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

constexpr int kHalvings = 12;  // of a patch before Newton's method takes over, over both directions
constexpr double kTolerance = 1e-9;  // of parameters

Eigen::AlignedBox2d hull_box(const BicubicBezier<Vector2d>& patch) {
  Eigen::AlignedBox2d box;
  for (const auto& row : patch.control) {
    for (const Vector2d& p : row) box.extend(p);
  }
  return box;
}

/// Newton's method from a starting point; nothing when it ends elsewhere or outside of the patch.
std::optional<Vector2d> refine(const BicubicHermite<Vector2d>& patch, const Vector2d& point,
                               Vector2d at, double size) {
  constexpr int kSteps = 12;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix2d jacobian;
    jacobian << patch.derivative_u(at.x(), at.y()), patch.derivative_v(at.x(), at.y());
    if (std::abs(jacobian.determinant()) < 1e-14 * size * size) return std::nullopt;
    at -= jacobian.inverse() * (patch.at(at.x(), at.y()) - point);
    at = at.cwiseMax(-1).cwiseMin(2);
  }
  if ((patch.at(at.x(), at.y()) - point).norm() > 1e-6 * size) return std::nullopt;
  const Vector2d inside = at.cwiseMax(0).cwiseMin(1);
  if ((inside - at).norm() > kTolerance) return std::nullopt;
  return inside;
}

struct Part {
  BicubicBezier<Vector2d> patch;
  Vector2d low, high;
  int halvings = 0;
};

std::optional<int> nearest_vertex(const Layer& layer, const Vector2d& point, double reach) {
  std::optional<int> nearest;
  const auto& vertices = layer.patches.mesh.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double distance = (layer.transform * vertices[v] - point).norm();
    if (distance > reach) continue;
    reach = distance;
    nearest = static_cast<int>(v);
  }
  return nearest;
}

/// Every control point lies within the corners' box grown by 4/3 of the longest tangent or chord,
/// as P + (P_u + P_v) / 3 + P_uv / 9 shows; this is quicker than making them.
bool may_hold(const PatchMesh& patches, int q, const Vector2d& point) {
  const QuadMesh& mesh = patches.mesh;
  Eigen::AlignedBox2d box;
  double longest = 0;
  for (int h = 4 * q; h < 4 * q + 4; ++h) {
    const Vector2d& corner = mesh.vertices[mesh.origin(h)];
    box.extend(corner);
    longest = std::max(longest, (mesh.vertices[mesh.tip(h)] - corner).norm());
    for (const Vector2d& tangent : patches.edge_tangents[mesh.edge(h)]) {
      longest = std::max(longest, tangent.norm());
    }
  }
  return box.exteriorDistance(point) <= 4.0 / 3 * longest;
}

std::optional<Pick> patch_at(const Layer& layer, int layer_index, const Vector2d& point) {
  const Vector2d local = layer.transform.inverse() * point;
  for (int q = 0; q < layer.patches.patch_count(); ++q) {
    if (!may_hold(layer.patches, q, local)) continue;
    const auto at = parameters_at(patch_geometry(layer.patches, q), local);
    if (at) return Pick{Pick::Kind::patch, layer_index, q, at->x(), at->y()};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pick> pick(const VectorImage& image, const Vector2d& point, double reach) {
  for (int l = static_cast<int>(image.layers.size()) - 1; l >= 0; --l) {
    if (const auto v = nearest_vertex(image.layers[l], point, reach)) {
      return Pick{Pick::Kind::vertex, l, *v};
    }
    if (const auto patch = patch_at(image.layers[l], l, point)) return patch;
  }
  return std::nullopt;
}

std::optional<Vector2d> parameters_at(const BicubicHermite<Vector2d>& patch,
                                      const Vector2d& point) {
  const BicubicBezier<Vector2d> bezier = to_bezier(patch);
  const double size = hull_box(bezier).diagonal().norm();
  std::vector<Part> parts = {{bezier, Vector2d(0, 0), Vector2d(1, 1)}};
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    if (hull_box(part.patch).exteriorDistance(point) > 1e-9 * size) continue;
    const Vector2d middle = (part.low + part.high) / 2;
    if (part.halvings >= kHalvings / 3 || part.halvings == 0) {
      if (const auto at = refine(patch, point, middle, size)) return at;
    }
    if (part.halvings == kHalvings) continue;
    const int axis = part.halvings % 2;
    const auto halves = axis == 0 ? part.patch.split_u() : part.patch.split_v();
    Vector2d high = part.high, low = part.low;
    high[axis] = low[axis] = middle[axis];
    parts.push_back({halves[1], low, part.high, part.halvings + 1});
    parts.push_back({halves[0], part.low, high, part.halvings + 1});
  }
  return std::nullopt;
}

}  // namespace quadrille::viewer
