#include "gltf_surface.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "gltf_color.h"
#include "gltf_pattern.h"

namespace quadrille {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Parameters of a point of a side, t along its direction.
Eigen::Vector2d on_side(int side, double t) {
  switch (side) {
    case 0:
      return {t, 0};
    case 1:
      return {1, t};
    case 2:
      return {1 - t, 1};
    default:
      return {0, 1 - t};
  }
}

std::array<float, 4> vertex_color(const Color& premultiplied, const Color& instead) {
  Color color = straight_color(premultiplied);
  // What is transparent takes the colour of its patch: triangles then show no dark fringe.
  if (!(color[3] > 0.5f / 255)) color.head<3>() = instead.head<3>();
  return {linear_light(color[0]), linear_light(color[1]), linear_light(color[2]), color[3]};
}

/// The mean colour of a patch, straight.
Color mean_color(const BicubicBezier<Color>& color) {
  Color sum = Color::Zero();
  for (const auto& row : color.control) {
    for (const Color& c : row) sum += clamped(c);
  }
  return straight_color(sum / 16);
}

class SurfaceMaker {
 public:
  SurfaceMaker(const SheetedLayer& layer, double picture_height, const SurfaceContent& content,
               const RunContext& context)
      : layer_(layer),
        mesh_(layer.mesh()),
        picture_height_(picture_height),
        content_(content),
        divisions_(divide(layer, content, context)),
        cutter_(layer.layer().transform.linear().determinant() < 0),
        parts_(layer.sheet_count()),
        previous_first_(layer.sheet_count(), kNone),
        corner_vertex_(mesh_.halfedge_count(), kNone),
        side_begin_(mesh_.halfedge_count(), kNone) {}

  std::vector<SurfacePart> run(const RunContext& context) {
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (q % 8192 == 0) context.progress("surface", 0.7 + 0.3 * q / mesh_.quad_count());
      if (layer_.is_drawn(q)) add_patch(q);
    }
    context.progress("surface", 1);
    return std::move(parts_);
  }

 private:
  /// A patch at work: its vertices are numbered in the part of its sheet.
  struct Patch {
    int quad;
    PatchPattern pattern;
    PatchPoints points;
    std::vector<std::uint32_t> vertices;
  };

  void add_patch(int q) {
    std::array<int, 4> sides;
    for (int side = 0; side < 4; ++side) sides[side] = divisions_.edges[mesh_.edge(4 * q + side)];
    Patch patch{q, PatchPattern(sides, divisions_.patches[q]), {}, {}};
    patch.points = patch_points(layer_, q, patch.pattern);
    patch.vertices.reserve(patch.points.size());
    for (int side = 0; side < 4; ++side) add_side(patch, side);
    add_inner(patch);
    add_triangles(patch);
  }

  void add_side(Patch& patch, int side) {
    const int h = 4 * patch.quad + side, n = patch.pattern.segments(side);
    std::uint32_t& corner = corner_vertex_[layer_.shared_corner(h)];
    if (corner == kNone) corner = add_vertex(patch, side, 0, corner_height(h));
    patch.vertices.push_back(corner);
    std::uint32_t& begin = side_begin_[layer_.shared_side(h)];
    const bool is_forward = mesh_.halfedge(mesh_.edge(h)) == h;
    if (begin == kNone) {
      begin = static_cast<std::uint32_t>(part(patch).positions.size());
      for (int k = 1; k < n; ++k) {
        add_vertex(patch, side, is_forward ? k : n - k, side_height(h, double(k) / n));
      }
    }
    for (int i = 1; i < n; ++i) patch.vertices.push_back(begin + (is_forward ? i : n - i) - 1);
  }

  void add_inner(Patch& patch) {
    const int columns = patch.pattern.columns(), rows = patch.pattern.rows();
    for (int j = 1; j < rows; ++j) {
      for (int i = 1; i < columns; ++i) {
        const Eigen::Vector2d uv(double(i) / columns, double(j) / rows);
        const double height = luma(layer_.color(patch.quad).at(uv.x(), uv.y()));
        const Eigen::Vector2f& point = patch.points[patch.vertices.size()];
        patch.vertices.push_back(add_vertex(patch.quad, point, uv, height));
      }
    }
  }

  void add_triangles(const Patch& patch) {
    const int sheet = layer_.sheet(patch.quad);
    for (const Polygon& polygon : patch.pattern.polygons()) {
      CutPolygon cut = cutter_.cut(polygon, patch.points);
      const int first = cut.triangles[0];
      if (patch.vertices[first] == previous_first_[sheet]) {
        cut = cutter_.cut(polygon, patch.points, first);
      }
      previous_first_[sheet] = patch.vertices[cut.triangles[0]];
      for (int k = 0; k < cut.count; ++k) {
        parts_[sheet].indices.push_back(patch.vertices[cut.triangles[k]]);
      }
    }
  }

  SurfacePart& part(const Patch& patch) { return parts_[layer_.sheet(patch.quad)]; }

  /// Vertex i of a side.
  std::uint32_t add_vertex(const Patch& patch, int side, int i, double height) {
    const int n = patch.pattern.segments(side);
    const Eigen::Vector2f& point = patch.points[patch.pattern.on_side(side, i)];
    return add_vertex(patch.quad, point, on_side(side, double(i) / n), height);
  }

  std::uint32_t add_vertex(int quad, const Eigen::Vector2f& point, const Eigen::Vector2d& uv,
                           double height) {
    SurfacePart& part = parts_[layer_.sheet(quad)];
    part.positions.push_back({point.x(), static_cast<float>(picture_height_ - point.y()),
                              static_cast<float>(content_.relief * height)});
    if (content_.has_colors) {
      const auto& color = layer_.color(quad);
      part.colors.push_back(vertex_color(color.at(uv.x(), uv.y()), mean_color(color)));
    }
    if (content_.has_normals) part.normals.push_back(normal(quad, uv));
    return static_cast<std::uint32_t>(part.positions.size() - 1);
  }

  double corner_height(int h) const {
    const std::vector<int> corners = layer_.colors_at(h);
    double sum = 0;
    for (const int corner : corners) {
      const Eigen::Vector2d uv = on_side(QuadMesh::corner_of(corner), 0);
      sum += luma(layer_.color(QuadMesh::quad_of(corner)).at(uv.x(), uv.y()));
    }
    return sum / static_cast<double>(corners.size());
  }

  /// At parameter t along the edge's own direction.
  double side_height(int h, double t) const {
    const int forward = mesh_.halfedge(mesh_.edge(h)), backward = mesh_.twin(forward);
    double sum = 0;
    int count = 0;
    for (const int side : {forward, backward}) {
      if (side < 0 || !layer_.is_drawn(QuadMesh::quad_of(side))) continue;
      const Eigen::Vector2d uv = on_side(QuadMesh::corner_of(side), side == forward ? t : 1 - t);
      sum += luma(layer_.color(QuadMesh::quad_of(side)).at(uv.x(), uv.y()));
      ++count;
    }
    return sum / count;
  }

  /// Of the surface z = relief * luma over the plane, before heights at tears are averaged.
  std::array<float, 3> normal(int quad, const Eigen::Vector2d& uv) const {
    if (content_.relief == 0) return {0, 0, 1};
    const auto position = placed_geometry(layer_.layer(), quad);
    const auto color = ferguson_patch(layer_.layer().patches, quad).color;
    const Color weights(0.2126f, 0.7152f, 0.0722f, 0);
    Eigen::Matrix2d jacobian;
    jacobian.row(0) = position.derivative_u(uv.x(), uv.y());
    jacobian.row(1) = position.derivative_v(uv.x(), uv.y());
    const Eigen::Vector2d slope(
        content_.relief * (color.derivative_u(uv.x(), uv.y()) * weights).sum(),
        content_.relief * (color.derivative_v(uv.x(), uv.y()) * weights).sum());
    const Eigen::Vector2d gradient = jacobian.inverse() * slope;
    if (!gradient.allFinite()) return {0, 0, 1};
    const Eigen::Vector3d n = Eigen::Vector3d(-gradient.x(), gradient.y(), 1).normalized();
    return {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())};
  }

  const SheetedLayer& layer_;
  const QuadMesh& mesh_;
  double picture_height_;
  SurfaceContent content_;
  SurfaceDivisions divisions_;
  PolygonCutter cutter_;
  std::vector<SurfacePart> parts_;
  std::vector<std::uint32_t> previous_first_;              // per sheet
  std::vector<std::uint32_t> corner_vertex_, side_begin_;  // #H, at shared corners and sides
};

}  // namespace

std::vector<SurfacePart> make_surface(const SheetedLayer& layer, double picture_height,
                                      const SurfaceContent& content, const RunContext& context) {
  return SurfaceMaker(layer, picture_height, content, context).run(context);
}

}  // namespace quadrille
