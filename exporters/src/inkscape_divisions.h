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

/// About the fewest parts, at most 8 (2 of bicubic ones), with which Inkscape's interpolation of the colours at the
/// crossings of lines stays near the patches' colours: within half of `tolerance`, in 8-bit steps,
/// in the root mean square. For bilinear ones also within twice of it anywhere.
GridDivisions divisions_of(const PlacedGrid& grid, bool bicubic, double tolerance);

}  // namespace quadrille
