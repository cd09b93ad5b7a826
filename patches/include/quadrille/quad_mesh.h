#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrille {

/// What an edge of a QuadMesh is, besides possibly a border.
enum EdgeFlag : std::uint8_t {
  kFeatureEdge = 1,  ///< lies on an image feature
  kTearEdge = 2,     ///< colours may jump across it
};

/// A planar mesh of quads with fixed connectivity and movable vertices.
///
/// Positions are in pixels of the picture, y down. The corners of a quad run so that its shoelace
/// area, sum of (x_k y_{k+1} - x_{k+1} y_k) / 2, is positive. In patch parameters the corners 0, 1,
/// 2, 3 are (u, v) = (0,0), (1,0), (1,1), (0,1).
///
/// Half-edge h = 4 * quad + k runs from corner k to corner k + 1 of its quad. Edges are numbered in
/// the order in which their first half-edge appears.
class QuadMesh {
 public:
  using Quad = std::array<int, 4>;

  QuadMesh() = default;
  /// Builds the adjacency in O(#Q). Throws Error{invalid_argument} when an index is out of range, a
  /// quad repeats a vertex, an edge has more than two quads or two quads run it the same way, a
  /// vertex joins more than one fan of quads, or a vertex belongs to no quad.
  QuadMesh(std::vector<Eigen::Vector2d> vertices, std::vector<Quad> quads);

  std::vector<Eigen::Vector2d> vertices;  ///< #V positions; may be moved freely
  std::vector<std::uint8_t> edge_flags;   ///< #E combinations of EdgeFlag, initially 0

  const std::vector<Quad>& quads() const { return quads_; }
  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int quad_count() const { return static_cast<int>(quads_.size()); }
  int edge_count() const { return static_cast<int>(edge_halfedge_.size()); }
  int halfedge_count() const { return 4 * quad_count(); }

  static int quad_of(int h) { return h >> 2; }
  static int corner_of(int h) { return h & 3; }
  static int next(int h) { return (h & ~3) | ((h + 1) & 3); }
  static int prev(int h) { return (h & ~3) | ((h + 3) & 3); }
  int origin(int h) const { return quads_[h >> 2][h & 3]; }
  int tip(int h) const { return quads_[h >> 2][(h + 1) & 3]; }
  /// The half-edge on the other side, or -1 at the border.
  int twin(int h) const { return twin_[h]; }
  int edge(int h) const { return edge_[h]; }
  /// The lower-numbered half-edge of an edge; it gives the edge its direction.
  int halfedge(int e) const { return edge_halfedge_[e]; }
  bool is_border(int e) const { return twin_[edge_halfedge_[e]] < 0; }
  bool is_tear(int e) const { return edge_flags[e] & kTearEdge; }

  /// The half-edges that leave v, one per incident quad, in the order in which a quad's next side
  /// follows its previous one around v. At a border vertex the fan is open: it starts with the
  /// half-edge that lies on the border. At an interior vertex it starts with the lowest half-edge.
  std::span<const int> fan(int v) const {
    return {fan_.data() + fan_begin_[v], fan_.data() + fan_begin_[v + 1]};
  }
  /// Index of h within fan(origin(h)).
  int fan_position(int h) const { return fan_position_[h]; }
  bool is_border_vertex(int v) const { return twin_[fan_[fan_begin_[v]]] < 0; }
  /// Number of edges at v.
  int valence(int v) const {
    return fan_begin_[v + 1] - fan_begin_[v] + (is_border_vertex(v) ? 1 : 0);
  }

 private:
  std::vector<Quad> quads_;
  std::vector<int> twin_, edge_, fan_, fan_position_;  // #H each
  std::vector<int> edge_halfedge_;                     // #E
  std::vector<int> fan_begin_;                         // #V + 1

  void link_edges();
  void order_fans();
};

/// The quads that touch one of the vertices, ascending.
std::vector<int> quads_at(const QuadMesh& mesh, std::span<const int> vertices);

/// The vertices of the quads, ascending.
std::vector<int> corners_of(const QuadMesh& mesh, std::span<const int> quads);

/// Regular means valence 4 inside and valence 3 on the border; the four border vertices of valence
/// 2 (a rectangle's corners) are regular too.
int count_irregular_vertices(const QuadMesh& mesh);

/// The smallest sine over the corner angles of quad q, negative when a corner is reflex; the scaled
/// Jacobian of mesh generation. 1 for a rectangle; 0 when an edge has no length.
double scaled_jacobian(const QuadMesh& mesh, int q);

/// Area of the straight-edged quad, square pixels; positive unless it is folded.
double quad_area(const QuadMesh& mesh, int q);

struct MeshViolation {
  std::string what;  ///< "border", "area", "corner", "euler", "not finite"
  int element = -1;  ///< the quad or vertex concerned, -1 for the whole mesh
  double value = 0;  ///< the offending number
};

/// Lists where the mesh fails to tile the rectangle [0, width] x [0, height] exactly: a coordinate
/// is not finite, V - E + F differs from 1, the border is not one loop through the rectangle's
/// corners along its sides, the signed areas do not sum up to width * height (relative 1e-9), or a
/// corner angle is not in (0, pi). Empty means valid.
std::vector<MeshViolation> validate(const QuadMesh& mesh, double width, double height);

}  // namespace quadrille
