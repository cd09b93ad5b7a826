#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "convex_faces.h"
#include "divide_faces.h"
#include "inside_test.h"
#include "lattice_graph.h"
#include "outline_sampling.h"
#include "quadrille/mesh_region.h"
#include "quadrille/quad_extraction.h"
#include "triangulation.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kClearance = 0.3;  // of lattice points from the outline's edges, in spacings
// Edges of the lattice between points of the outline at most so many steps apart cut off ears.
constexpr int kEarSteps = 3;

/// The lattice points inside that are not too near to the edges between the samples.
std::vector<char> clear_points(const LatticeGraph& graph, const OutlineSamples& outline) {
  std::vector<Loop> loops;
  for (std::size_t l = 0; l + 1 < outline.loop_begin.size(); ++l) {
    loops.emplace_back(outline.points.begin() + outline.loop_begin[l],
                       outline.points.begin() + outline.loop_begin[l + 1]);
  }
  const std::vector<Contour> contours(loops.begin(), loops.end());
  const double mean_spacing =
      std::accumulate(graph.spacing.begin(), graph.spacing.end(), 0.0) / graph.spacing.size();
  const CurveIndex index(segments_of(contours), std::max(2.0, mean_spacing));
  const InsideTest inside(loops);
  std::vector<char> clear;
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const Vector2d& p = graph.points[i];
    clear.push_back(inside(p) && !index.nearest(p, kClearance * graph.spacing[i]));
  }
  return clear;
}

/// True when the edge between two of the outline's points would cut off a face without an inner
/// vertex, which is flat where the outline is smooth.
bool cuts_off_ear(const OutlineSamples& outline, int p, int q) {
  const int steps = outline.steps_between(p, q);
  return steps >= 0 && steps <= kEarSteps;
}

/// The triangulation of the outline and the lattice points that are clear of it.
Triangulation triangulate(const LatticeGraph& graph, const OutlineSamples& outline, double width,
                          double height, double units, std::set<std::array<int, 2>>& border) {
  const auto to_grid = [&](const Vector2d& p) -> GridPoint {
    const auto coordinate = [&](double c, double size) {
      return std::clamp<std::int64_t>(std::llround(c * units), 0,
                                      static_cast<std::int64_t>(size * units));
    };
    return {coordinate(p.x(), width), coordinate(p.y(), height)};
  };
  Triangulation triangulation(static_cast<std::int64_t>(width * units),
                              static_cast<std::int64_t>(height * units));
  std::vector<int> vertex_of_sample;
  for (const Vector2d& p : outline.points) {
    vertex_of_sample.push_back(triangulation.insert(to_grid(p)));
  }
  for (int p = 0; p < static_cast<int>(outline.points.size()); ++p) {
    const int u = vertex_of_sample[p], v = vertex_of_sample[outline.next(p)];
    triangulation.insert_edge(u, v);
    border.insert({u, v});
  }
  const std::vector<char> clear = clear_points(graph, outline);
  std::vector<int> vertex_of_point;
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const int sample = outline.sample_of_lattice_point[i];
    vertex_of_point.push_back(sample >= 0 ? vertex_of_sample[sample]
                              : clear[i]  ? triangulation.insert(to_grid(graph.points[i]))
                                          : -1);
  }
  for (const auto& [a, b] : graph.edges) {
    const int u = vertex_of_point[a], v = vertex_of_point[b];
    if (u < 0 || v < 0) continue;
    const int p = outline.sample_of_lattice_point[a], q = outline.sample_of_lattice_point[b];
    if (p >= 0 && q >= 0 && cuts_off_ear(outline, p, q)) continue;
    triangulation.insert_edge(u, v);
  }
  return triangulation;
}

/// The triangles on the positive side of the border's edges: those next to it, and all that are
/// reached from them without crossing it.
std::vector<char> inside_triangles(const Triangulation& triangulation,
                                   const std::set<std::array<int, 2>>& border) {
  const auto& triangles = triangulation.triangles();
  std::vector<char> inside(triangles.size(), 0);
  std::vector<int> open;
  const auto side = [&](int t, int k) -> std::array<int, 2> {
    return {triangles[t].vertex[(k + 1) % 3], triangles[t].vertex[(k + 2) % 3]};
  };
  const auto enter = [&](int t) {
    if (inside[t]) return;
    inside[t] = 1;
    open.push_back(t);
  };
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (triangles[t].fixed[k] && border.contains(side(t, k))) enter(t);
    }
  }
  while (!open.empty()) {
    const int t = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const bool is_border = triangles[t].fixed[k] && border.contains(side(t, k));
      if (!is_border && triangles[t].neighbour[k] >= 0) enter(triangles[t].neighbour[k]);
    }
  }
  return inside;
}

/// The merged faces whose triangles lie inside.
std::vector<std::vector<int>> inside_faces(const Triangulation& triangulation,
                                           const std::set<std::array<int, 2>>& border) {
  const std::vector<char> inside = inside_triangles(triangulation, border);
  std::set<std::array<int, 2>> sides;
  for (std::size_t t = 0; t < inside.size(); ++t) {
    if (!inside[t]) continue;
    const auto& v = triangulation.triangles()[t].vertex;
    for (int k = 0; k < 3; ++k) sides.insert({v[k], v[(k + 1) % 3]});
  }
  std::vector<std::vector<int>> faces = convex_faces(triangulation);
  std::erase_if(faces, [&](const std::vector<int>& face) {
    return !sides.contains({face[0], face[1]});
  });
  return faces;
}

QuadMesh mesh_inside(const LatticeGraph& graph, const std::vector<Loop>& outline,
                     const Spacing& spacing, double width, double height,
                     const RunContext& context) {
  const OutlineSamples samples = sample_outline(outline, graph, spacing, width, height);
  const double units = units_per_pixel(graph, width, height);
  std::set<std::array<int, 2>> border;
  const Triangulation triangulation = triangulate(graph, samples, width, height, units, border);
  std::vector<std::vector<int>> faces = inside_faces(triangulation, border);

  std::vector<int> point_of_vertex(triangulation.points().size(), -1);
  std::vector<Vector2d> points;
  for (std::vector<int>& face : faces) {
    for (int& v : face) {
      if (point_of_vertex[v] < 0) {
        point_of_vertex[v] = static_cast<int>(points.size());
        const GridPoint& p = triangulation.points()[v];
        points.emplace_back(static_cast<double>(p.x) / units, static_cast<double>(p.y) / units);
      }
      v = point_of_vertex[v];
    }
  }
  QuadMesh mesh = divide_faces(points, faces, {}, context, &samples);
  if (validate_region(mesh, width, height).empty()) return mesh;
  // Strands of the outline that nearly touch may leave no room for other connectivity.
  return divide_faces(std::move(points), faces, {}, context, &samples, /*clean=*/false);
}

LatticeGraph regular_graph(double width, double height, double edge) {
  const int columns = std::max(1, static_cast<int>(std::lround(width / edge)));
  // The number of cells follows the edge more closely than rows of that height would.
  const double cells = width * height / (edge * edge);
  const int rows = std::max(1, static_cast<int>(std::lround(cells / columns)));
  LatticeGraph graph;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const int p = static_cast<int>(graph.points.size());
      graph.points.emplace_back(width * i / columns, height * j / rows);
      graph.spacing.push_back(edge);
      if (i > 0) graph.edges.push_back({p - 1, p});
      if (j > 0) graph.edges.push_back({p - columns - 1, p});
    }
  }
  return graph;
}

}  // namespace

QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions,
                       const std::vector<Loop>& outline, double width, double height,
                       const RunContext& context) {
  context.progress("quads", 0);
  const double scale_x = width / field.z.width, scale_y = height / field.z.height;
  const LatticeGraph graph =
      scaled(lattice_graph(features, field, scale, positions), scale_x, scale_y);
  const Spacing spacing = [&](const Vector2d& p) {
    const int x = std::clamp(static_cast<int>(p.x() / scale_x), 0, field.z.width - 1);
    const int y = std::clamp(static_cast<int>(p.y() / scale_y), 0, field.z.height - 1);
    return std::sqrt(scale_x * scale_y) * std::min(scale.along_x(x, y), scale.along_y(x, y));
  };
  return mesh_inside(graph, outline, spacing, width, height, context);
}

QuadMesh lattice_mesh(const std::vector<Loop>& outline, double width, double height, double edge) {
  const double face_edge = 2 * edge;  // faces are divided once
  return mesh_inside(regular_graph(width, height, face_edge), outline,
                     [=](const Vector2d&) { return face_edge; }, width, height, {});
}

}  // namespace quadrille
