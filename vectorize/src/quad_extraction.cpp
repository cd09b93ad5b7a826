// Design: the lattice of the position field, assembled by a constrained Delaunay triangulation on
// an integer grid. The paper's greedy extraction (section 3.3, after Jakob et al. 2015) leaves
// holes and has no border; here the faces tile the rectangle whatever the fields are.
#include "quadrille/quad_extraction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "chain_curve.h"
#include "chain_sampling.h"
#include "convex_faces.h"
#include "divide_faces.h"
#include "face_cleanup.h"
#include "feature_bending.h"
#include "feature_release.h"
#include "lattice_graph.h"
#include "outline_bending.h"
#include "shape_smoothing.h"
#include "triangulation.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kFlatCosine = 0.5;     // of the turn at a corner that ought to be divided
constexpr double kLeastSine = 0.2;      // of corners beside chains
constexpr double kShortestPiece = 1.5;  // pixels of a chain that are divided

/// The triangulation of lattice points and chains.
class Assembly {
 public:
  Assembly(const LatticeGraph& graph, const ChainNetwork& chains, const DirectedSpacing& spacing,
           double width, double height)
      : graph_(graph),
        chains_(chains),
        samples_(sample_chains(chains, graph, spacing, width, height)),
        width_(width),
        height_(height),
        units_(units_per_pixel(graph, width, height)),
        triangulation_(static_cast<std::int64_t>(width * units_),
                       static_cast<std::int64_t>(height * units_)) {
    for (const Vector2d& p : samples_.points) vertex_of_sample_.push_back(insert(p));
    insert_chains();
    insert_lattice();
    open_ears();
  }

  const Triangulation& triangulation() const { return triangulation_; }
  const std::vector<FeatureEdge>& features() const { return features_; }
  std::vector<Vector2d> points() const {
    std::vector<Vector2d> points;
    for (const GridPoint& p : triangulation_.points()) {
      points.emplace_back(static_cast<double>(p.x) / units_, static_cast<double>(p.y) / units_);
    }
    return points;
  }

 private:
  const LatticeGraph& graph_;
  const ChainNetwork& chains_;
  ChainSamples samples_;
  double width_, height_, units_;
  Triangulation triangulation_;
  std::vector<int> vertex_of_sample_;
  std::vector<FeatureEdge> features_;

  int insert(const Vector2d& p) {
    const auto coordinate = [&](double c, double size) {
      return std::clamp<std::int64_t>(std::llround(c * units_), 0,
                                      static_cast<std::int64_t>(size * units_));
    };
    return triangulation_.insert({coordinate(p.x(), width_), coordinate(p.y(), height_)});
  }

  /// The strongest chains first: what comes too near to them is left out.
  void insert_chains() {
    std::vector<int> order(samples_.pieces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return chains_.chains[samples_.pieces[a].chain].contrast >
             chains_.chains[samples_.pieces[b].chain].contrast;
    });
    for (const int i : order) {
      const ChainSamples::Piece& piece = samples_.pieces[i];
      insert_piece(ChainCurve(chains_.chains[piece.chain].points), piece.from, piece.to,
                   vertex_of_sample_[piece.a], vertex_of_sample_[piece.b]);
    }
  }

  void insert_piece(const ChainCurve& curve, double from, double to, int a, int b) {
    if (a == b) return;
    const Vector2d midpoint = curve.at(0.5 * (from + to));
    if (triangulation_.insert_edge(a, b)) {
      features_.push_back({{a, b}, midpoint});
    } else if (to - from > kShortestPiece) {
      const int middle = insert(midpoint);
      insert_piece(curve, from, 0.5 * (from + to), a, middle);
      insert_piece(curve, 0.5 * (from + to), to, middle, b);
    }
  }

  /// A triangle between two pieces of a chain has a corner that is flat where the chain is smooth;
  /// an edge across it divides that corner.
  void open_ears() {
    std::set<std::array<int, 2>> chain_edges;
    for (const FeatureEdge& edge : features_) {
      const auto [a, b] = std::minmax(edge.ends[0], edge.ends[1]);
      chain_edges.insert({a, b});
    }
    std::vector<std::array<int, 2>> wanted;
    for (const Triangulation::Triangle& t : triangulation_.triangles()) {
      for (int k = 0; k < 3; ++k) {
        const int v = t.vertex[k], a = t.vertex[(k + 1) % 3], b = t.vertex[(k + 2) % 3];
        const auto is_chain = [&](int n) {
          return chain_edges.contains({std::min(v, n), std::max(v, n)});
        };
        if (t.fixed[k] || t.neighbour[k] < 0 || !is_chain(a) || !is_chain(b)) continue;
        if (!is_flat(a, v, b)) continue;
        const auto& far = triangulation_.triangles()[t.neighbour[k]].vertex;
        const int w =
            *std::find_if(far.begin(), far.end(), [&](int n) { return n != a && n != b; });
        wanted.push_back({v, w});
      }
    }
    for (const auto& [v, w] : wanted) triangulation_.insert_edge(v, w);
  }

  bool is_flat(int a, int v, int b) const {
    const auto at = [&](int i) {
      const GridPoint& p = triangulation_.points()[i];
      return Vector2d(static_cast<double>(p.x), static_cast<double>(p.y));
    };
    const Vector2d in = (at(v) - at(a)).normalized(), out = (at(b) - at(v)).normalized();
    return in.dot(out) > kFlatCosine;
  }

  void insert_lattice() {
    std::vector<int> vertex_of(graph_.points.size(), -1);
    // Row by row, so that each walk to the next point is short.
    std::vector<int> order(graph_.points.size());
    std::iota(order.begin(), order.end(), 0);
    const double row_height = *std::max_element(graph_.spacing.begin(), graph_.spacing.end());
    const auto row = [&](int i) { return std::floor(graph_.points[i].y() / row_height); };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      if (row(a) != row(b)) return row(a) < row(b);
      return graph_.points[a].x() < graph_.points[b].x();
    });
    for (const int i : order) {
      const int sample = samples_.sample_of_lattice_point[i];
      if (sample == kInTheWay) continue;
      vertex_of[i] = sample >= 0 ? vertex_of_sample_[sample] : insert(graph_.points[i]);
    }
    for (const auto& [a, b] : graph_.edges) {
      if (vertex_of[a] < 0 || vertex_of[b] < 0 || vertex_of[a] == vertex_of[b]) continue;
      const int p = samples_.sample_of_lattice_point[a], q = samples_.sample_of_lattice_point[b];
      if (p >= 0 && q >= 0 && samples_.is_ear(p, q)) continue;
      triangulation_.insert_edge(vertex_of[a], vertex_of[b]);
    }
  }
};

/// Vertices of the border that bending has taken off their lines stay where they are now.
void fix_bent_border(const QuadMesh& mesh, std::vector<VertexGuide>& guides) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_border_vertex(v)) continue;
    const auto fan = mesh.fan(v);
    const Vector2d here = mesh.vertices[v];
    const Vector2d after = mesh.vertices[mesh.tip(fan.front())] - here;
    const Vector2d before = mesh.vertices[mesh.origin(QuadMesh::prev(fan.back()))] - here;
    if (after.x() * before.y() != after.y() * before.x()) guides[v] = VertexGuide::at(here);
  }
}

}  // namespace

QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions,
                       const ChainNetwork& chains, double width, double height,
                       const RunContext& context) {
  context.progress("quads", 0);
  const double scale_x = width / field.z.width, scale_y = height / field.z.height;
  const LatticeGraph graph =
      scaled(lattice_graph(features, field, scale, positions), scale_x, scale_y);
  const DirectedSpacing spacing = directed_spacing(field, scale, scale_x, scale_y);
  const Assembly assembly(graph, chains, spacing, width, height);
  return divide_faces(assembly.points(), convex_faces(assembly.triangulation()),
                      assembly.features(), context);
}

QuadMesh divide_faces(std::vector<Vector2d> points, const std::vector<std::vector<int>>& polygons,
                      const std::vector<FeatureEdge>& features, const RunContext& context,
                      const OutlineSamples* outline, bool clean) {
  FaceMesh faces(std::move(points), polygons);
  for (const FeatureEdge& edge : features) faces.keep_edge(edge.ends[0], edge.ends[1]);
  if (clean) clean_up(faces, context);
  std::vector<VertexGuide> guides;
  std::vector<HalvedEdge> halved;
  QuadMesh mesh = faces.split(guides, halved);
  bend_features(mesh, features, halved, guides);
  if (outline) {
    bend_outline(mesh, *outline);
    fix_bent_border(mesh, guides);
  }
  smooth_shape(mesh, guides);
  if (!features.empty()) release_bad_features(mesh, guides, kLeastSine);
  return mesh;
}

}  // namespace quadrille
