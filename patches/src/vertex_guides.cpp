#include "vertex_guides.h"

#include <cmath>

namespace quadrille {
namespace {

constexpr double kStraightest = 0.70710678118654752;  // cosine of the largest turn
constexpr int kPieces = 16;                           // of a curve whose length is measured

bool has_tear(const QuadMesh& mesh, int v) {
  for (const int h : mesh.fan(v)) {
    if (mesh.is_tear(mesh.edge(h)) || mesh.is_tear(mesh.edge(QuadMesh::prev(h)))) return true;
  }
  return false;
}

}  // namespace

VertexGuides::VertexGuides(const PatchMesh& patches)
    : patches_(patches), guides_(patches.mesh.vertex_count()) {
  const QuadMesh& mesh = patches.mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const bool torn = has_tear(mesh, v);
    if (mesh.is_border_vertex(v)) {
      guides_[v] = border_guide(v);
      if (torn) guides_[v].kind = Kind::fixed;
    } else if (torn) {
      guides_[v] = tear_guide(v);
    }
  }
}

VertexGuides::Guide VertexGuides::border_guide(int v) const {
  const QuadMesh& mesh = patches_.mesh;
  const int out = mesh.fan(v).front(), in = QuadMesh::prev(mesh.fan(v).back());
  const Eigen::Vector2d &before = mesh.vertices[mesh.origin(in)], &here = mesh.vertices[v],
                        &after = mesh.vertices[mesh.tip(out)];
  Guide guide;
  guide.kind = Kind::fixed;
  for (int axis = 0; axis < 2; ++axis) {
    const int across = 1 - axis;
    if (before[across] != here[across] || here[across] != after[across]) continue;
    guide.kind = Kind::line;
    guide.direction[axis] = 1;
  }
  return guide;
}

VertexGuides::Guide VertexGuides::tear_guide(int v) const {
  const QuadMesh& mesh = patches_.mesh;
  Guide guide;
  guide.kind = Kind::fixed;
  int count = 0;
  for (const int h : mesh.fan(v)) {
    if (!mesh.is_tear(mesh.edge(h))) continue;
    if (count < 2) guide.ahead_behind[count] = h;
    ++count;
  }
  if (count != 2) return guide;
  const Eigen::Vector2d ahead = tangent_along(patches_, guide.ahead_behind[0], 0).normalized();
  const Eigen::Vector2d behind = tangent_along(patches_, guide.ahead_behind[1], 0).normalized();
  if (!(-ahead.dot(behind) > kStraightest)) return guide;
  guide.kind = Kind::chain;
  guide.direction = (ahead - behind).normalized();
  return guide;
}

Eigen::Vector2d VertexGuides::along_edge(int h, double distance) const {
  const QuadMesh& mesh = patches_.mesh;
  const Eigen::Vector2d &p = mesh.vertices[mesh.origin(h)], &q = mesh.vertices[mesh.tip(h)];
  const Eigen::Vector2d start = tangent_along(patches_, h, 0), end = tangent_along(patches_, h, 1);
  const auto curve = [&](double t) -> Eigen::Vector2d {
    const auto b = hermite_basis(t);
    return p * b[0] + start * b[1] + q * b[2] + end * b[3];
  };
  Eigen::Vector2d last = p;
  for (int i = 1; i <= kPieces; ++i) {
    const Eigen::Vector2d next = curve(static_cast<double>(i) / kPieces);
    const double length = (next - last).norm();
    if (distance <= length && length > 0) return curve((i - 1 + distance / length) / kPieces);
    distance -= length;
    last = next;
  }
  return q;
}

Eigen::Vector2d VertexGuides::moved(int v, const Eigen::Vector2d& step) const {
  const Eigen::Vector2d& here = patches_.mesh.vertices[v];
  const Guide& guide = guides_[v];
  if (guide.kind == Kind::free) return here + step;
  if (guide.kind == Kind::fixed) return here;
  const double distance = guide.direction.dot(step);
  if (guide.kind == Kind::line) return here + distance * guide.direction;
  if (distance == 0) return here;
  return along_edge(guide.ahead_behind[distance > 0 ? 0 : 1], std::abs(distance));
}

}  // namespace quadrille
