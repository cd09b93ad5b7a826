#pragma once

#include <vector>

#include "placed_grid.h"

namespace quadrille {

/// Into how many equal parts each column and each row of a grid's quads is divided.
struct GridDivisions {
  std::vector<int> columns, rows;
};

/// Where a line between the parts lies: the column (or row) of quads and the parameter in it.
struct GridLine {
  int quad;
  double at;
};

/// The lines before, between and after the parts.
std::vector<GridLine> lines_of(const std::vector<int>& divisions);

/// True when Inkscape's smooth interpolation between the corners of the grid's quads is within half
/// of `tolerance` of the patches' colours, in 8-bit steps, in the root mean square. Never of a
/// single column or row, whose slopes it takes wrongly.
bool is_faithful_bicubic(const PlacedGrid& grid, double tolerance);

/// One part each where the interpolation is `bicubic`; otherwise about the fewest, at most 4, with
/// which the bilinear one is within the tolerance, see bilinear_divisions().
GridDivisions divisions_of(const PlacedGrid& grid, bool bicubic, double tolerance);

}  // namespace quadrille
