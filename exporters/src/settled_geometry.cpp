#include "settled_geometry.h"

namespace quadrille {
namespace {

/// Places vertices from those that have a place on, ring by ring.
void place_vertices(QuadMesh& mesh, std::vector<char> has_place) {
  std::vector<int> ring;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (has_place[v]) ring.push_back(v);
    if (!has_place[v]) mesh.vertices[v].setZero();
  }
  std::vector<int> around(mesh.vertex_count(), 0);
  while (!ring.empty()) {
    std::vector<int> next;
    for (const int v : ring) {
      for (const int h : mesh.fan(v)) {
        for (const int other : mesh.quads()[QuadMesh::quad_of(h)]) {
          if (has_place[other]) continue;
          if (around[other]++ == 0) next.push_back(other);
          mesh.vertices[other] += mesh.vertices[v];
        }
      }
    }
    for (const int v : next) {
      mesh.vertices[v] /= around[v];
      has_place[v] = 1;
    }
    ring = std::move(next);
  }
}

}  // namespace

void settle_geometry(Layer& layer, const std::vector<char>& is_sound) {
  PatchMesh& patches = layer.patches;
  QuadMesh& mesh = patches.mesh;
  std::vector<char> has_place(mesh.vertex_count(), 0), is_kept(mesh.edge_count(), 0);
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (is_sound[QuadMesh::quad_of(h)]) has_place[mesh.origin(h)] = is_kept[mesh.edge(h)] = 1;
  }
  place_vertices(mesh, has_place);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (is_kept[e]) continue;
    const int h = mesh.halfedge(e);
    patches.edge_tangents[e].fill(mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)]);
  }
}

}  // namespace quadrille
