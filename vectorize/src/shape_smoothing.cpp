#include "shape_smoothing.h"

#include <algorithm>
#include <vector>

namespace quadrille {
namespace {

constexpr double kGoodSine = 0.7;  // smallest corner sine above which a vertex is left alone
constexpr double kHold = 1;        // see VertexStar::improved()
constexpr int kSweeps = 4;

void collect_star(const QuadMesh& mesh, int v, std::vector<StarWedge>& wedges) {
  wedges.clear();
  for (const int h : mesh.fan(v)) {
    const Eigen::Vector2d& opposite = mesh.vertices[mesh.tip(QuadMesh::next(h))];
    wedges.push_back({opposite, mesh.vertices[mesh.origin(QuadMesh::prev(h))],
                      mesh.vertices[mesh.tip(h)], opposite});
  }
}

}  // namespace

void smooth_shape(QuadMesh& mesh, std::span<const VertexGuide> guides) {
  const std::vector<Eigen::Vector2d> anchors = mesh.vertices;
  std::vector<StarWedge> wedges;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool moved = false;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      collect_star(mesh, v, wedges);
      const VertexStar star(wedges);
      Eigen::Vector2d& p = mesh.vertices[v];
      const double before = star.smallest_sine(p);
      if (before >= kGoodSine) continue;
      const Eigen::Vector2d q = star.improved(p, guides[v], anchors[v], kHold);
      if (q == p || star.smallest_sine(q) < before) continue;
      p = q;
      moved = true;
    }
    if (!moved) return;
  }
}

namespace {

/// Lets a vertex go where it likes, along the border if it lies there.
void release(QuadMesh& mesh, int v, std::span<VertexGuide> guides) {
  for (const int h : mesh.fan(v)) {
    for (const int e : {mesh.edge(h), mesh.edge(QuadMesh::prev(h))}) {
      mesh.edge_flags[e] &= static_cast<std::uint8_t>(~kFeatureEdge);
    }
  }
  if (!mesh.is_border_vertex(v)) guides[v] = VertexGuide::free();
}

/// Lets a vertex inside a chain of feature edges slide along it.
void loosen(const QuadMesh& mesh, int v, std::span<VertexGuide> guides) {
  if (mesh.is_border_vertex(v)) return;
  std::vector<Eigen::Vector2d> ends;
  for (const int h : mesh.fan(v)) {
    if (mesh.edge_flags[mesh.edge(h)] & kFeatureEdge) ends.push_back(mesh.vertices[mesh.tip(h)]);
  }
  if (ends.size() != 2 || ends[0] == ends[1]) return;
  guides[v] = VertexGuide::on_line(mesh.vertices[v], (ends[1] - ends[0]).normalized());
}

/// The vertices of some quads and of the quads around them, ascending.
std::vector<int> vertices_around(const QuadMesh& mesh, const std::vector<int>& quads) {
  std::vector<int> found;
  for (const int q : quads) {
    for (const int v : mesh.quads()[q]) {
      for (const int h : mesh.fan(v)) {
        const auto& corners = mesh.quads()[QuadMesh::quad_of(h)];
        found.insert(found.end(), corners.begin(), corners.end());
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

void release_bad_features(QuadMesh& mesh, std::span<VertexGuide> guides, double least_sine) {
  constexpr int kRounds = 12, kReleaseSweeps = 12;
  constexpr double kLooseHold = 0.02;
  std::vector<StarWedge> wedges;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<int> bad;
    for (int q = 0; q < mesh.quad_count(); ++q) {
      if (scaled_jacobian(mesh, q) < least_sine) bad.push_back(q);
    }
    if (bad.empty()) return;
    // Smoothing alone first, then with vertices that slide along their features.
    for (const int q : bad) {
      for (const int v : mesh.quads()[q]) {
        if (round == 1) loosen(mesh, v, guides);
        if (round > 1) release(mesh, v, guides);
      }
    }
    for (int sweep = 0; sweep < kReleaseSweeps; ++sweep) {
      for (const int v : vertices_around(mesh, bad)) {
        collect_star(mesh, v, wedges);
        const VertexStar star(wedges);
        Eigen::Vector2d& p = mesh.vertices[v];
        const Eigen::Vector2d q = star.improved(p, guides[v], p, kLooseHold);
        if (star.smallest_sine(q) >= std::min(star.smallest_sine(p), kGoodSine)) p = q;
      }
    }
  }
}

}  // namespace quadrille
