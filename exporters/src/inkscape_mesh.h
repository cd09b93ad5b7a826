#pragma once

#include <Eigen/Core>
#include <vector>

#include "placed_grid.h"
#include "subdivision.h"

namespace quadrille {

/// A mesh gradient as Inkscape draws it: a lattice of Coons patches whose corners have colours.
struct InkscapeMesh {
  /// Interpolate colours smoothly across patches instead of bilinearly within each.
  bool bicubic = false;
  int columns = 0, rows = 0;

  std::vector<Eigen::Vector2d> nodes;  ///< (columns + 1) x (rows + 1), row by row, in pixels
  std::vector<Color> colors;           ///< of the nodes, premultiplied, within [0, 1]
  std::vector<PlaneCurve> across;      ///< columns x (rows + 1) sides from left to right
  std::vector<PlaneCurve> down;        ///< (columns + 1) x rows sides downward

  int node(int column, int row) const { return row * (columns + 1) + column; }
  int side_across(int column, int row) const { return row * columns + column; }
  int side_down(int column, int row) const { return row * (columns + 1) + column; }
};

/// The mesh gradient of the grid. It reaches `bleed` pixels beyond the grid on all sides, where
/// geometry and colours go on as inside: drawn without anti-aliasing, it is to be cut out by a
/// path. A grid of two or more columns and rows is bicubic; others, for which Inkscape's slopes are
/// wrong, are bilinear. Columns and rows of quads are divided as divisions_of() says for
/// `tolerance`.
InkscapeMesh inkscape_mesh(const PlacedGrid& grid, double bleed, double tolerance);

}  // namespace quadrille
