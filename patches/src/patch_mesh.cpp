#include "quadrille/patch_mesh.h"

#include <utility>

#include "quadrille/vector_image.h"

namespace quadrille {
namespace {

/// Numbers the wedges of one vertex along its fan, starting with number `next`; returns the number
/// after the last one. In a closed fan the corners before the first tear edge belong to the last
/// wedge, because the fan may start in the middle of one.
int number_wedges(const QuadMesh& mesh, int v, int next, std::vector<int>& wedge_of_corner) {
  const auto fan = mesh.fan(v);
  int tears = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const bool inner = mesh.twin(fan[i]) >= 0;
    tears += inner && mesh.is_tear(mesh.edge(fan[i]));
  }
  const bool closed = !mesh.is_border_vertex(v);
  const int count = closed ? (tears >= 2 ? tears : 1) : tears + 1;
  int current = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const bool tear_before = mesh.twin(fan[i]) >= 0 && mesh.is_tear(mesh.edge(fan[i]));
    if (tear_before) ++current;
    wedge_of_corner[fan[i]] = next + current % count;
  }
  return next + count;
}

BicubicHermite<Eigen::Vector2d> with_adini_twists(BicubicHermite<Eigen::Vector2d> p) {
  const Eigen::Vector2d mixed = p.value[2] - p.value[1] - p.value[3] + p.value[0];
  constexpr int kAcrossU[4] = {1, 0, 3, 2}, kAcrossV[4] = {3, 2, 1, 0};
  for (int k = 0; k < 4; ++k) {
    const double su = (k == 1 || k == 2) ? -1 : 1, sv = (k >= 2) ? -1 : 1;
    p.duv[k] = (p.du[kAcrossV[k]] - p.du[k]) * sv + (p.dv[kAcrossU[k]] - p.dv[k]) * su - mixed;
  }
  return p;
}

}  // namespace

PatchMesh straight_patches(QuadMesh mesh) {
  PatchMesh patches;
  patches.edge_tangents.resize(mesh.edge_count());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const Eigen::Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
    patches.edge_tangents[e] = {chord, chord};
  }
  patches.wedge_of_corner.resize(mesh.halfedge_count());
  int wedge_count = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    wedge_count = number_wedges(mesh, v, wedge_count, patches.wedge_of_corner);
  }
  patches.wedges.resize(wedge_count);
  for (Wedge& w : patches.wedges) w.value = Color(0, 0, 0, 1);
  patches.mesh = std::move(mesh);
  return patches;
}

Eigen::Vector2d tangent_along(const PatchMesh& patches, int h, int at) {
  const int e = patches.mesh.edge(h);
  const auto& tangents = patches.edge_tangents[e];
  if (patches.mesh.halfedge(e) == h) return tangents[at];
  return -tangents[1 - at];
}

BicubicHermite<Eigen::Vector2d> patch_geometry(const PatchMesh& patches, int q) {
  const QuadMesh& mesh = patches.mesh;
  BicubicHermite<Eigen::Vector2d> p;
  for (int k = 0; k < 4; ++k) p.value[k] = mesh.vertices[mesh.quads()[q][k]];
  const int h = 4 * q;
  p.du[0] = tangent_along(patches, h, 0);
  p.du[1] = tangent_along(patches, h, 1);
  p.dv[1] = tangent_along(patches, h + 1, 0);
  p.dv[2] = tangent_along(patches, h + 1, 1);
  p.du[2] = -tangent_along(patches, h + 2, 0);
  p.du[3] = -tangent_along(patches, h + 2, 1);
  p.dv[3] = -tangent_along(patches, h + 3, 0);
  p.dv[0] = -tangent_along(patches, h + 3, 1);
  return with_adini_twists(p);
}

FergusonPatch ferguson_patch(const PatchMesh& patches, int q) {
  FergusonPatch patch{patch_geometry(patches, q), {}};
  const auto& p = patch.position;
  for (int k = 0; k < 4; ++k) {
    const int h = 4 * q + k;
    const Wedge& w = patches.wedges[patches.wedge_of_corner[h]];
    const float scale =
        static_cast<float>(twist_sign(patches.mesh, h) * p.du[k].norm() * p.dv[k].norm());
    const auto along = [&](const Eigen::Vector2d& t) -> Color {
      return w.dx * static_cast<float>(t.x()) + w.dy * static_cast<float>(t.y());
    };
    patch.color.value[k] = w.value;
    patch.color.du[k] = along(p.du[k]);
    patch.color.dv[k] = along(p.dv[k]);
    patch.color.duv[k] = along(p.duv[k]) + w.twist * scale;
  }
  return patch;
}

BezierPatch bezier_patch(const PatchMesh& patches, int q) {
  const FergusonPatch patch = ferguson_patch(patches, q);
  return {to_bezier(patch.position), to_bezier(patch.color)};
}

}  // namespace quadrille
