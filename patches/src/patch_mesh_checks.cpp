#include <algorithm>

#include "quadrille/patch_mesh.h"

namespace quadrille {
namespace {

std::string wrong_size(std::size_t is, std::size_t should_be, const char* what) {
  if (is == should_be) return {};
  return "it has " + std::to_string(is) + " " + what + " instead of " + std::to_string(should_be);
}

bool is_finite(const Wedge& w) {
  return w.value.allFinite() && w.dx.allFinite() && w.dy.allFinite() && w.twist.allFinite();
}

/// The wedges may be numbered in any order, but must divide the corners of each vertex as its tears
/// do, and every wedge must be in use.
std::string wedge_contradiction(const PatchMesh& patches) {
  const PatchMesh reference = straight_patches(patches.mesh);
  const std::string size = wrong_size(patches.wedges.size(), reference.wedges.size(), "wedges");
  if (!size.empty()) return size;
  const int count = static_cast<int>(reference.wedges.size());
  std::vector<int> wedge_of_reference(count, -1), reference_of_wedge(count, -1);
  for (std::size_t h = 0; h < reference.wedge_of_corner.size(); ++h) {
    const int r = reference.wedge_of_corner[h], w = patches.wedge_of_corner[h];
    if (w < 0 || w >= count) return "a wedge is out of range";
    if (wedge_of_reference[r] < 0 && reference_of_wedge[w] < 0) {
      wedge_of_reference[r] = w;
      reference_of_wedge[w] = r;
    }
    if (wedge_of_reference[r] != w || reference_of_wedge[w] != r) {
      return "the wedges contradict the tears";
    }
  }
  return {};
}

}  // namespace

std::string contradiction_in(const PatchMesh& patches) {
  const QuadMesh& mesh = patches.mesh;
  const std::size_t edges = mesh.edge_count(), corners = mesh.halfedge_count();
  std::string wrong = wrong_size(mesh.edge_flags.size(), edges, "edge flags");
  if (wrong.empty()) wrong = wrong_size(patches.edge_tangents.size(), edges, "edge tangents");
  if (wrong.empty()) wrong = wrong_size(patches.wedge_of_corner.size(), corners, "corners");
  if (!wrong.empty()) return wrong;
  const bool finite =
      std::ranges::all_of(mesh.vertices, [](const auto& v) { return v.allFinite(); }) &&
      std::ranges::all_of(patches.edge_tangents,
                          [](const auto& t) { return t[0].allFinite() && t[1].allFinite(); }) &&
      std::ranges::all_of(patches.wedges, is_finite);
  return finite ? wedge_contradiction(patches) : "a number is not finite";
}

}  // namespace quadrille
