#include <utility>

#include "layer_parts.h"
#include "quadrille/picture_layers.h"

namespace quadrille {
namespace {

class ControlNet {
 public:
  void add(const Layer& layer, int layer_index) {
    const PatchMesh& patches = layer.patches;
    const QuadMesh& mesh = patches.mesh;
    const int first = static_cast<int>(shapes_.points.size());
    for (const Eigen::Vector2d& v : mesh.vertices) shapes_.points.push_back(layer.transform * v);
    first_of_edges_ = static_cast<int>(shapes_.points.size());
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const int h = mesh.halfedge(e);
      const Eigen::Vector2d &from = mesh.vertices[mesh.origin(h)], &to = mesh.vertices[mesh.tip(h)];
      const int inner = static_cast<int>(shapes_.points.size());
      shapes_.points.push_back(layer.transform * (from + patches.edge_tangents[e][0] / 3));
      shapes_.points.push_back(layer.transform * (to - patches.edge_tangents[e][1] / 3));
      add_line({first + mesh.origin(h), inner, inner + 1, first + mesh.tip(h)});
    }
    for (int q = 0; q < mesh.quad_count(); ++q) add_inside(layer, q);
    layer_.resize(shapes_.cell_count(), layer_index);
  }

  SceneShapes finish() {
    shapes_.cell = SceneShapes::Cell::line;
    shapes_.cell_arrays = {scene_array("layer", "layer of the picture, from 0", std::move(layer_))};
    return std::move(shapes_);
  }

 private:
  void add_line(std::array<int, 4> points) {
    shapes_.cell_points.insert(shapes_.cell_points.end(), points.begin(), points.end());
    shapes_.end_cell();
  }

  /// The two control points inside the edge of half-edge h, along h.
  std::array<int, 2> inside_edge(const QuadMesh& mesh, int h) const {
    const int e = mesh.edge(h), first = first_of_edges_ + 2 * e;
    if (mesh.halfedge(e) == h) return {first, first + 1};
    return {first + 1, first};
  }

  void add_inside(const Layer& layer, int q) {
    const auto net = to_bezier(patch_geometry(layer.patches, q)).control;
    const int inner = static_cast<int>(shapes_.points.size());
    for (int j = 1; j < 3; ++j) {
      for (int i = 1; i < 3; ++i) shapes_.points.push_back(layer.transform * net[j][i]);
    }
    const QuadMesh& mesh = layer.patches.mesh;
    const auto bottom = inside_edge(mesh, 4 * q), right = inside_edge(mesh, 4 * q + 1),
               top = inside_edge(mesh, 4 * q + 2), left = inside_edge(mesh, 4 * q + 3);
    for (int k = 0; k < 2; ++k) {
      add_line({left[1 - k], inner + 2 * k, inner + 2 * k + 1, right[k]});
      add_line({bottom[k], inner + k, inner + 2 + k, top[1 - k]});
    }
  }

  SceneShapes shapes_;
  std::vector<std::int32_t> layer_;
  int first_of_edges_ = 0;
};

}  // namespace

SceneLayer control_net_layer(const VectorImage& image) {
  ControlNet net;
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    net.add(image.layers[l], static_cast<int>(l));
  }
  SceneLayer layer{"control-net", "the Bezier control points and the nets between them"};
  layer.style.ink = kBlue;
  layer.content = net.finish();
  return layer;
}

}  // namespace quadrille
