#include "shape_smoothing.h"

#include <algorithm>
#include <vector>

namespace quadrille {
namespace {

constexpr double kHold = 1;  // see VertexStar::improved()
constexpr int kSweeps = 4;

}  // namespace

void collect_star(const QuadMesh& mesh, int v, std::vector<StarWedge>& wedges) {
  wedges.clear();
  for (const int h : mesh.fan(v)) {
    const Eigen::Vector2d& opposite = mesh.vertices[mesh.tip(QuadMesh::next(h))];
    wedges.push_back({opposite, mesh.vertices[mesh.origin(QuadMesh::prev(h))],
                      mesh.vertices[mesh.tip(h)], opposite});
  }
}

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

}  // namespace quadrille
