#pragma once

#include <vector>

#include "svg_cell_mesh.h"
#include "svg_cells.h"

namespace quadrille {

/// Cells that are painted together.
struct MergedCells {
  std::vector<int> cells;  ///< ascending
  CellSamples samples;     ///< of all of them
  double cost = 0;         ///< squared error and price of the bytes
};

/// Merges neighbouring cells as long as the cost falls, those first that save most. A byte costs
/// `price` in squared error, both as in SvgDetail; coordinates are multiples of 1 / units_per_pixel
/// pixel. No group has a tear inside of it. Groups come in the order of their first cells. Works on
/// several threads.
std::vector<MergedCells> merge_cells(const CellMesh& mesh, std::vector<SvgCell> cells, double price,
                                     int units_per_pixel);

}  // namespace quadrille
