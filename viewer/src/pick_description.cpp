#include <fmt/core.h>

#include <Eigen/Core>

#include "pick.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

std::string place(const Vector2d& p) { return fmt::format("{:.2f}, {:.2f}", p.x(), p.y()); }

int first_patch(const VectorImage& image, int layer) {
  int first = 0;
  for (int l = 0; l < layer; ++l) first += image.layers[l].patches.patch_count();
  return first;
}

std::string describe_patch(const VectorImage& image, const Pick& pick,
                           const std::vector<float>& errors) {
  const Layer& layer = image.layers[pick.layer];
  const QuadMesh& mesh = layer.patches.mesh;
  std::string text = fmt::format("patch {}  layer {}  u {:.3f}  v {:.3f}\n", pick.index, pick.layer,
                                 pick.u, pick.v);
  for (const int v : mesh.quads()[pick.index]) {
    text += fmt::format("corner: vertex {} at {}\n", v, place(layer.transform * mesh.vertices[v]));
  }
  text += fmt::format("scaled Jacobian {:.3f}\n", scaled_jacobian(mesh, pick.index));
  const std::size_t at = first_patch(image, pick.layer) + pick.index;
  text += at < errors.size() ? fmt::format("fitting error {:.2f} of 255", errors[at])
                             : "fitting error unknown without a source";
  return text;
}

std::string describe_vertex(const VectorImage& image, const Pick& pick) {
  const Layer& layer = image.layers[pick.layer];
  const QuadMesh& mesh = layer.patches.mesh;
  const int v = pick.index;
  std::string text = fmt::format("vertex {}  layer {}\nvalence {}{}\nat {}", v, pick.layer,
                                 mesh.valence(v), mesh.is_border_vertex(v) ? " (border)" : "",
                                 place(layer.transform * mesh.vertices[v]));
  std::vector<int> wedges;
  for (const int h : mesh.fan(v)) {
    const int wedge = layer.patches.wedge_of_corner[h];
    if (wedges.empty() || std::find(wedges.begin(), wedges.end(), wedge) == wedges.end()) {
      wedges.push_back(wedge);
    }
  }
  for (const int wedge : wedges) {
    const Color c = layer.patches.wedges[wedge].value * 255;
    text += fmt::format("\nwedge {}: {:.1f} {:.1f} {:.1f}", wedge, c[0], c[1], c[2]);
    if (!layer.patches.opaque) text += fmt::format(" alpha {:.1f}", c[3]);
  }
  return text;
}

SceneShapes patch_outline(const Layer& layer, int q, double tolerance) {
  SceneShapes shapes;
  shapes.cell = SceneShapes::Cell::line;
  const PatchMesh& patches = layer.patches;
  for (int h = 4 * q; h < 4 * q + 4; ++h) {
    const Vector2d &from = patches.mesh.vertices[patches.mesh.origin(h)],
                   &to = patches.mesh.vertices[patches.mesh.tip(h)];
    const Vector2d start = tangent_along(patches, h, 0), end = tangent_along(patches, h, 1);
    const int n = curve_segments({layer.transform * from, layer.transform * (from + start / 3),
                                  layer.transform * (to - end / 3), layer.transform * to},
                                 tolerance);
    for (int i = 0; i < n; ++i) {
      const auto basis = hermite_basis(static_cast<double>(i) / n);
      shapes.points.push_back(
          layer.transform * (basis[0] * from + basis[1] * start + basis[2] * to + basis[3] * end));
    }
  }
  const int count = static_cast<int>(shapes.points.size());
  for (int i = 0; i <= count; ++i) shapes.cell_points.push_back(i % count);
  shapes.end_cell();
  return shapes;
}

}  // namespace

std::string describe(const VectorImage& image, const Pick& pick, const std::vector<float>& errors) {
  return pick.kind == Pick::Kind::vertex ? describe_vertex(image, pick)
                                         : describe_patch(image, pick, errors);
}

SceneLayer picked_layer(const VectorImage& image, const Pick& pick, const SceneWindow& window) {
  constexpr Ink kHighlight = {255, 140, 0};
  const Layer& layer = image.layers[pick.layer];
  SceneLayer picked{"picked", "what was clicked"};
  picked.style.ink = kHighlight;
  picked.style.width = 3;
  if (pick.kind == Pick::Kind::vertex) {
    SceneShapes shapes;
    shapes.points = {layer.transform * layer.patches.mesh.vertices[pick.index]};
    picked.style.marker = Marker::mark;
    picked.content = std::move(shapes);
  } else {
    picked.content = patch_outline(layer, pick.index, window.tolerance);
  }
  return picked;
}

}  // namespace quadrille::viewer
