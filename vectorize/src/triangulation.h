#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace quadrille {

/// A point on an integer grid; |coordinates| <= 2^29 keeps every predicate exact in 128 bits.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  bool operator==(const GridPoint&) const = default;
};

/// Twice the signed area of a, b, c; positive when they turn from x toward y.
std::int64_t orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Constrained Delaunay triangulation of points in a rectangle, by incremental insertion and flips
/// (Lawson; Sloan, A fast algorithm for generating constrained Delaunay triangulations, 1993).
/// Predicates are exact, so the triangles always tile the rectangle and none is inverted.
class Triangulation {
 public:
  struct Triangle {
    std::array<int, 3> vertex;     ///< positive orientation
    std::array<int, 3> neighbour;  ///< across the edge opposite vertex[k]; -1 outside
    std::array<bool, 3> fixed;     ///< that edge is a constraint
  };

  /// The rectangle [0, width] x [0, height]; its corners become vertices 0 to 3 in the order
  /// (0,0), (w,0), (w,h), (0,h).
  Triangulation(std::int64_t width, std::int64_t height);

  /// Adds a point of the rectangle and returns its vertex; an existing one when it coincides.
  int insert(const GridPoint& p);

  /// Makes the segment between two vertices an edge that later changes respect. False, and nothing
  /// changed, when it crosses another constraint or runs through a third vertex.
  bool insert_edge(int a, int b);

  const std::vector<GridPoint>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::vector<GridPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> triangle_of_;  // some triangle at each vertex
  int last_ = 0;

  /// A triangle and the index of one of its edges (that of the opposite vertex).
  struct Side {
    int triangle, edge;
  };
  enum class Place { inside, on_edge, on_vertex };
  Side locate(const GridPoint& p, Place& place) const;
  void split_triangle(int t, int p);
  void split_edge(Side side, int p);
  void legalise(std::vector<Side>& queue);
  bool is_flippable(Side side) const;
  bool violates_delaunay(Side side) const;
  void flip(Side side);
  int mirrored_edge(Side side) const;
  void replace_neighbour(int t, int from, int to);
  Side find_edge(int a, int b) const;
  bool crossed_edges(int a, int b, std::vector<std::array<int, 2>>& crossed) const;
};

}  // namespace quadrille
