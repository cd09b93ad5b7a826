#include <utility>

#include "layer_parts.h"
#include "quadrille/mesh_region.h"
#include "quadrille/picture_layers.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr int kCurveSegments = 12;  // of a patch's edge, unless a window asks for others

/// The control points of the curve of edge e in the picture's coordinates.
std::array<Vector2d, 4> edge_control(const Layer& layer, int e) {
  const QuadMesh& mesh = layer.patches.mesh;
  const int h = mesh.halfedge(e);
  const Vector2d &from = mesh.vertices[mesh.origin(h)], &to = mesh.vertices[mesh.tip(h)];
  const auto& [start, end] = layer.patches.edge_tangents[e];
  return {layer.transform * from, layer.transform * (from + start / 3),
          layer.transform * (to - end / 3), layer.transform * to};
}

bool may_meet(const std::array<Vector2d, 4>& control, const Eigen::AlignedBox2d& region) {
  Eigen::AlignedBox2d hull;
  for (const Vector2d& p : control) hull.extend(p);
  return hull.intersects(region);
}

/// Curves of edges of all layers, with what is known of each.
class EdgeCurves {
 public:
  explicit EdgeCurves(const std::optional<SceneWindow>& window) : window_(window) {}

  void add(const Layer& layer, int layer_index, int e) {
    const QuadMesh& mesh = layer.patches.mesh;
    int segments = kCurveSegments;
    if (window_) {
      const auto control = edge_control(layer, e);
      if (!may_meet(control, window_->region)) return;
      segments = curve_segments(control, window_->tolerance);
    }
    for (int i = 0; i <= segments; ++i) {
      shapes_.cell_points.push_back(static_cast<int>(shapes_.points.size()));
      shapes_.points.push_back(layer.transform *
                               edge_point(layer.patches, e, static_cast<double>(i) / segments));
    }
    shapes_.end_cell();
    layer_.push_back(layer_index);
    edge_.push_back(e);
    border_.push_back(mesh.is_border(e));
    feature_.push_back((mesh.edge_flags[e] & kFeatureEdge) != 0);
    tear_.push_back(mesh.is_tear(e));
  }

  SceneShapes finish(bool with_flags) {
    shapes_.cell = SceneShapes::Cell::line;
    auto& arrays = shapes_.cell_arrays;
    arrays.push_back(scene_array("layer", "layer of the picture, from 0", std::move(layer_)));
    arrays.push_back(scene_array("edge", "number of the edge in its layer", std::move(edge_)));
    if (with_flags) {
      arrays.push_back(scene_array("border", "1 on the border of the mesh", std::move(border_)));
      arrays.push_back(
          scene_array("feature", "1 on a feature of the picture", std::move(feature_)));
      arrays.push_back(scene_array("tear", "1 where colours may jump across", std::move(tear_)));
    }
    return std::move(shapes_);
  }

 private:
  const std::optional<SceneWindow>& window_;
  SceneShapes shapes_;
  std::vector<std::int32_t> layer_, edge_;
  std::vector<std::uint8_t> border_, feature_, tear_;
};

/// Marks at vertices of irregular valence.
class IrregularVertices {
 public:
  void add(const QuadMesh& mesh, int layer_index, const Eigen::Affine2d& transform) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.is_border_vertex(v) || mesh.valence(v) == 4) continue;
      shapes_.points.push_back(transform * mesh.vertices[v]);
      vertex_.push_back(v);
      valence_.push_back(mesh.valence(v));
      layer_.push_back(layer_index);
      for (const int c : mesh.valence(v) < 4 ? kRed : kBlue) {
        ink_.push_back(static_cast<std::uint8_t>(c));
      }
    }
  }

  SceneLayer finish() {
    auto& arrays = shapes_.point_arrays;
    arrays.push_back(scene_array("rgb", "red below valence 4, blue above", std::move(ink_), 3,
                                 SceneArray::Kind::color));
    arrays.push_back(scene_array("valence", "edges at the vertex", std::move(valence_)));
    arrays.push_back(
        scene_array("vertex", "number of the vertex in its layer", std::move(vertex_)));
    arrays.push_back(scene_array("layer", "layer of the picture, from 0", std::move(layer_)));
    SceneLayer layer{"irregular-vertices",
                     "vertices inside the mesh of valence 3 or less red, 5 or more blue"};
    layer.style.marker = Marker::mark;
    layer.style.colors = "rgb";
    layer.content = std::move(shapes_);
    return layer;
  }

 private:
  SceneShapes shapes_;
  std::vector<std::int32_t> vertex_, valence_, layer_;
  std::vector<std::uint8_t> ink_;
};

}  // namespace

SceneLayer edge_layer(const VectorImage& image, const std::optional<SceneWindow>& window) {
  EdgeCurves curves(window);
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    const int edges = image.layers[l].patches.mesh.edge_count();
    for (int e = 0; e < edges; ++e) curves.add(image.layers[l], static_cast<int>(l), e);
  }
  SceneLayer layer{"patch-edges", "the curved edges of the patches"};
  layer.content = curves.finish(true);
  return layer;
}

SceneLayer tear_layer(const VectorImage& image, const std::optional<SceneWindow>& window) {
  EdgeCurves curves(window);
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    const QuadMesh& mesh = image.layers[l].patches.mesh;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (mesh.is_tear(e)) curves.add(image.layers[l], static_cast<int>(l), e);
    }
  }
  SceneLayer layer{"tears", "edges across which colours may jump"};
  layer.style.ink = kRed;
  layer.style.width = 2;
  layer.content = curves.finish(false);
  return layer;
}

SceneLayer irregular_vertex_layer(const VectorImage& image) {
  IrregularVertices vertices;
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    vertices.add(image.layers[l].patches.mesh, static_cast<int>(l), image.layers[l].transform);
  }
  return vertices.finish();
}

SceneLayer irregular_vertex_layer(const QuadMesh& mesh) {
  IrregularVertices vertices;
  vertices.add(mesh, 0, Eigen::Affine2d::Identity());
  return vertices.finish();
}

SceneLayer quad_layer(const QuadMesh& mesh) {
  SceneShapes shapes;
  shapes.cell = SceneShapes::Cell::polygon;
  shapes.points = mesh.vertices;
  std::vector<std::int32_t> valence, quad;
  std::vector<std::uint8_t> border;
  std::vector<float> jacobian;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    valence.push_back(mesh.valence(v));
    border.push_back(mesh.is_border_vertex(v));
  }
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const QuadMesh::Quad& corners = mesh.quads()[q];
    shapes.cell_points.insert(shapes.cell_points.end(), corners.begin(), corners.end());
    shapes.end_cell();
    quad.push_back(q);
    jacobian.push_back(static_cast<float>(scaled_jacobian(mesh, q)));
  }
  shapes.point_arrays = {
      scene_array("valence", "edges at the vertex", std::move(valence)),
      scene_array("border", "1 on the border of the mesh", std::move(border)),
  };
  shapes.cell_arrays = {
      scene_array("quad", "number of the quad", std::move(quad)),
      scene_array("region", "smooth region that tears and the border bound", smooth_regions(mesh)),
      scene_array("scaled_jacobian", "smallest sine of the corner angles, 1 for a rectangle",
                  std::move(jacobian)),
  };
  SceneLayer layer{"quads", "the quads with straight edges"};
  layer.content = std::move(shapes);
  return layer;
}

}  // namespace quadrille
