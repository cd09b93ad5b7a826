#include "feature_release.h"

#include <algorithm>
#include <vector>

#include "shape_smoothing.h"

namespace quadrille {
namespace {

constexpr int kRounds = 12, kSweeps = 12;
constexpr double kHold = 0.02;  // see VertexStar::improved()
// Rounds in which the corners of bad quads are spread, and later those of the quads around them.
constexpr int kSpreadRound = 4, kWideSpreadRound = 8, kSpreadSweeps = 8;

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

/// Draws free vertices to the middle of their neighbours, which opens quads that have shrunk to
/// almost nothing; smoothing alone moves a vertex in proportion to the edges there.
void spread(QuadMesh& mesh, std::span<const int> vertices, std::span<const VertexGuide> guides) {
  for (int sweep = 0; sweep < kSpreadSweeps; ++sweep) {
    for (const int v : vertices) {
      if (mesh.is_border_vertex(v) || guides[v].kind != VertexGuide::Kind::free) continue;
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (const int h : mesh.fan(v)) sum += mesh.vertices[mesh.tip(h)];
      mesh.vertices[v] = sum / static_cast<double>(mesh.fan(v).size());
    }
  }
}

}  // namespace

void release_bad_features(QuadMesh& mesh, std::span<VertexGuide> guides, double least_sine) {
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
    const std::vector<int> corners = corners_of(mesh, bad);
    const std::vector<int> around = corners_of(mesh, quads_at(mesh, corners));
    if (round == kSpreadRound) spread(mesh, corners, guides);
    if (round == kWideSpreadRound) {
      for (const int v : around) release(mesh, v, guides);
      spread(mesh, around, guides);
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const int v : around) {
        collect_star(mesh, v, wedges);
        const VertexStar star(wedges);
        Eigen::Vector2d& p = mesh.vertices[v];
        const Eigen::Vector2d q = star.improved(p, guides[v], p, kHold);
        if (star.smallest_sine(q) >= std::min(star.smallest_sine(p), kGoodSine)) p = q;
      }
    }
  }
}

}  // namespace quadrille
