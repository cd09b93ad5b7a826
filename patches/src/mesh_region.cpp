#include "quadrille/mesh_region.h"

#include <algorithm>

namespace quadrille {
namespace {

std::vector<Loop> positions_of(const QuadMesh& mesh, const std::vector<std::vector<int>>& loops) {
  std::vector<Loop> positions;
  for (const std::vector<int>& loop : loops) {
    Loop& points = positions.emplace_back();
    for (const int v : loop) points.push_back(mesh.vertices[v]);
  }
  return positions;
}

}  // namespace

std::vector<std::vector<int>> border_loops(const QuadMesh& mesh) {
  std::vector<std::vector<int>> loops;
  std::vector<char> seen(mesh.halfedge_count(), 0);
  for (int start = 0; start < mesh.halfedge_count(); ++start) {
    if (mesh.twin(start) >= 0 || seen[start]) continue;
    std::vector<int>& loop = loops.emplace_back();
    for (int h = start; !seen[h]; h = mesh.fan(mesh.tip(h)).front()) {
      seen[h] = 1;
      loop.push_back(mesh.origin(h));
    }
  }
  return loops;
}

MeshRegionSize region_size(const QuadMesh& mesh) {
  MeshRegionSize size;
  for (const Loop& loop : positions_of(mesh, border_loops(mesh))) {
    const double area = signed_area(loop);
    ++(area > 0 ? size.components : size.holes);
    size.area += area;
    size.outline_length += perimeter(loop);
  }
  return size;
}

std::vector<int> smooth_regions(const QuadMesh& mesh) {
  std::vector<int> region(mesh.quad_count(), -1), open;
  int count = 0;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (region[q] >= 0) continue;
    open.assign(1, q);
    region[q] = count;
    while (!open.empty()) {
      const int from = open.back();
      open.pop_back();
      for (int h = 4 * from; h < 4 * from + 4; ++h) {
        const int twin = mesh.is_tear(mesh.edge(h)) ? -1 : mesh.twin(h);
        if (twin < 0 || region[QuadMesh::quad_of(twin)] >= 0) continue;
        region[QuadMesh::quad_of(twin)] = count;
        open.push_back(QuadMesh::quad_of(twin));
      }
    }
    ++count;
  }
  return region;
}

std::vector<MeshViolation> validate_region(const QuadMesh& mesh, double width, double height) {
  std::vector<MeshViolation> found;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector2d& p = mesh.vertices[v];
    if (!p.allFinite()) {
      found.push_back({"not finite", v, 0});
    } else if (p.x() < 0 || p.y() < 0 || p.x() > width || p.y() > height) {
      found.push_back({"outside", v, std::max({-p.x(), -p.y(), p.x() - width, p.y() - height})});
    }
  }
  if (!found.empty()) return found;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const double sine = scaled_jacobian(mesh, q);
    if (!(sine > 0)) found.push_back({"corner", q, sine});
  }

  const auto loops = border_loops(mesh);
  const std::vector<Loop> border = positions_of(mesh, loops);
  int components = 0, holes = 0;
  for (const Loop& loop : border) ++(signed_area(loop) > 0 ? components : holes);
  const int euler = mesh.vertex_count() - mesh.edge_count() + mesh.quad_count();
  if (euler != components - holes) found.push_back({"euler", -1, static_cast<double>(euler)});
  for (const auto& [side, other] : conflicts(border)) {
    found.push_back({"border", loops[side.loop][side.index],
                     static_cast<double>(loops[other.loop][other.index])});
  }
  if (found.empty() && !is_nested(border)) found.push_back({"nesting", -1, 0});
  return found;
}

}  // namespace quadrille
