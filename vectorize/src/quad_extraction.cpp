// Design: the lattice of the position field, assembled by a constrained Delaunay triangulation on
// an integer grid. The paper's greedy extraction (section 3.3, after Jakob et al. 2015) leaves
// holes and has no border; here the faces tile the rectangle whatever the fields are.
#include "quadrille/quad_extraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "convex_faces.h"
#include "divide_faces.h"
#include "lattice_graph.h"
#include "outline_bending.h"
#include "shape_smoothing.h"
#include "triangulation.h"

namespace quadrille {
namespace {

constexpr double kGridUnitsPerSpacing = 512;  // resolution of the integer grid
constexpr double kLeastUnitsPerPixel = 64;

/// Integer units per source pixel: a whole number, so that the rectangle's corners are grid points.
double units_per_pixel(const LatticeGraph& graph, double scale) {
  double least = std::numeric_limits<double>::max();
  for (const double s : graph.spacing) least = std::min(least, s * scale);
  return std::max(kLeastUnitsPerPixel, std::ceil(kGridUnitsPerSpacing / least));
}

Triangulation triangulate(const LatticeGraph& graph, double scale_x, double scale_y, double width,
                          double height, double units) {
  const auto w = static_cast<std::int64_t>(width * units);
  const auto h = static_cast<std::int64_t>(height * units);
  Triangulation triangulation(w, h);
  std::vector<int> vertex_of(graph.points.size());
  // Row by row, so that each walk to the next point is short.
  std::vector<int> order(graph.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const double row_height = *std::max_element(graph.spacing.begin(), graph.spacing.end());
  const auto row = [&](int i) { return std::floor(graph.points[i].y() / row_height); };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    if (row(a) != row(b)) return row(a) < row(b);
    return graph.points[a].x() < graph.points[b].x();
  });
  for (const int i : order) {
    const Eigen::Vector2d& p = graph.points[i];
    const GridPoint g{std::clamp<std::int64_t>(std::llround(p.x() * scale_x * units), 0, w),
                      std::clamp<std::int64_t>(std::llround(p.y() * scale_y * units), 0, h)};
    vertex_of[i] = triangulation.insert(g);
  }
  for (const auto& [a, b] : graph.edges) triangulation.insert_edge(vertex_of[a], vertex_of[b]);
  return triangulation;
}

/// Catmull-Clark connectivity: every n-gon becomes n quads around its centre, joined at the
/// midpoints of its edges. Faces are strictly convex, so all quads are.
QuadMesh split_faces(std::vector<Eigen::Vector2d> points,
                     const std::vector<std::vector<int>>& faces) {
  std::map<std::array<int, 2>, int> midpoints;
  const auto midpoint = [&](int a, int b) {
    const auto [it, is_new] =
        midpoints.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(points.size()));
    if (is_new) points.push_back(0.5 * (points[a] + points[b]));
    return it->second;
  };
  std::vector<QuadMesh::Quad> quads;
  for (const std::vector<int>& face : faces) {
    const int n = static_cast<int>(face.size());
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const int v : face) centre += points[v] / n;
    const int c = static_cast<int>(points.size());
    points.push_back(centre);
    for (int k = 0; k < n; ++k) {
      const int before = midpoint(face[(k + n - 1) % n], face[k]);
      const int after = midpoint(face[k], face[(k + 1) % n]);
      quads.push_back({face[k], after, c, before});
    }
  }
  return QuadMesh(std::move(points), std::move(quads));
}

}  // namespace

QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions, double width,
                       double height, const RunContext& context) {
  context.progress("quads", 0);
  const LatticeGraph graph = lattice_graph(features, field, scale, positions);
  const double scale_x = width / field.z.width, scale_y = height / field.z.height;
  const double units = units_per_pixel(graph, std::min(scale_x, scale_y));
  const Triangulation triangulation = triangulate(graph, scale_x, scale_y, width, height, units);
  std::vector<Eigen::Vector2d> points;
  for (const GridPoint& p : triangulation.points()) {
    points.emplace_back(static_cast<double>(p.x) / units, static_cast<double>(p.y) / units);
  }
  return divide_faces(std::move(points), convex_faces(triangulation), width, height);
}

QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& faces, double width, double height,
                      const OutlineSamples* outline) {
  QuadMesh mesh = split_faces(std::move(points), faces);
  if (outline) bend_outline(mesh, *outline);
  smooth_bad_quads(mesh, width, height);
  return mesh;
}

}  // namespace quadrille
