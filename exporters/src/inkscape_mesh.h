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

/// The mesh gradient of the grid: bicubic with a patch per quad where is_faithful_bicubic() says so
/// for the tolerance, bilinear with columns and rows divided by divisions_of() elsewhere. It
/// reaches `bleed` pixels beyond the grid on all sides, where geometry and colours go on as inside:
/// drawn without anti-aliasing, it is to be cut out by a path. For that the outermost patches are
/// prolonged, or a row is added where one of them is short.
InkscapeMesh inkscape_mesh(const PlacedGrid& grid, double bleed, double tolerance);

}  // namespace quadrille
