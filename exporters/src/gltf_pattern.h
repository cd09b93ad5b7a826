#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sheeted_layer.h"

namespace quadrille {

/// A quad, or a triangle with -1 in the last place, of local vertices of a patch; they run
/// counter-clockwise in (u, v).
using Polygon = std::array<int, 4>;

/// How a patch is cut into quads and few triangles: a regular grid wherever a side has as many
/// segments as the grid has columns (or rows), and a strip of transition along the other sides.
///
/// Local vertices are numbered along the sides (0: v = 0, 1: u = 1, 2: v = 1, 3: u = 0, each from
/// its corner up to before the next one), then row by row inside.
class PatchPattern {
 public:
  /// Neither of grid's numbers may be below that of its sides, and 1 only when one of the sides
  /// along the other direction has as many segments as the grid.
  PatchPattern(const std::array<int, 4>& segments, const std::array<int, 2>& grid);

  int segments(int side) const { return segments_[side]; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Vertex i of a side, 0 <= i <= segments(side).
  int on_side(int side, int i) const;
  /// The vertex at (i / columns, j / rows), inside or on a side with as many segments.
  int on_grid(int i, int j) const;
  int vertex_count() const { return inner_begin_ + (columns_ - 1) * (rows_ - 1); }
  const std::vector<Polygon>& polygons() const { return polygons_; }

 private:
  bool is_regular(int side) const { return segments_[side] == (side % 2 == 0 ? columns_ : rows_); }
  void add_strip(int side);

  std::array<int, 4> segments_, side_begin_;
  int columns_, rows_, inner_begin_;
  int i0_, i1_, j0_, j1_;  // the regular part of the grid
  std::vector<Polygon> polygons_;
};

/// Where the local vertices lie in the picture, in single precision and y down.
using PatchPoints = std::vector<Eigen::Vector2f>;
PatchPoints patch_points(const SheetedLayer& layer, int quad, const PatchPattern& pattern);

/// The polygon as a fan around its first vertex: for a quad two triangles.
struct CutPolygon {
  std::array<int, 6> triangles;  ///< local vertices, counter-clockwise with y up
  int count = 3;                 ///< of them
  bool faces_front = true;       ///< no triangle is turned or without area
};

/// Cuts polygons one after the other so that no two in a row start with the same vertex: by that
/// FB_ngon_encoding tells them apart. A quad is cut along its shorter diagonal, unless that would
/// turn a triangle.
class PolygonCutter {
 public:
  /// Patches that a transform mirrors run the other way round.
  explicit PolygonCutter(bool is_mirrored) : is_mirrored_(is_mirrored) {}
  /// `previous_first` is the first vertex of the polygon before, -1 for none.
  CutPolygon cut(const Polygon& polygon, const PatchPoints& points, int previous_first = -1) const;

 private:
  bool is_mirrored_;
};

}  // namespace quadrille
