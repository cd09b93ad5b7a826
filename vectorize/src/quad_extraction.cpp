// Design: the lattice of the position field, assembled by a constrained Delaunay triangulation on
// an integer grid. The paper's greedy extraction (section 3.3, after Jakob et al. 2015) leaves
// holes and has no border; here the faces tile the rectangle whatever the fields are.
#include "quadrille/quad_extraction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "convex_faces.h"
#include "divide_faces.h"
#include "face_cleanup.h"
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

/// Vertices of the border that bending has taken off their lines stay where they are now.
void fix_bent_border(const QuadMesh& mesh, std::vector<VertexGuide>& guides) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_border_vertex(v)) continue;
    const auto fan = mesh.fan(v);
    const Eigen::Vector2d here = mesh.vertices[v];
    const Eigen::Vector2d after = mesh.vertices[mesh.tip(fan.front())] - here;
    const Eigen::Vector2d before = mesh.vertices[mesh.origin(QuadMesh::prev(fan.back()))] - here;
    if (after.x() * before.y() != after.y() * before.x()) guides[v] = VertexGuide::at(here);
  }
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
  return divide_faces(std::move(points), convex_faces(triangulation), context);
}

QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& polygons, const RunContext& context,
                      const OutlineSamples* outline, bool clean) {
  FaceMesh faces(std::move(points), polygons);
  if (clean) clean_up(faces, context);
  std::vector<VertexGuide> guides;
  QuadMesh mesh = faces.split(guides);
  if (outline) {
    bend_outline(mesh, *outline);
    fix_bent_border(mesh, guides);
  }
  smooth_shape(mesh, guides);
  return mesh;
}

}  // namespace quadrille
