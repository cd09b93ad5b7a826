#pragma once

#include <vector>

#include "svg_cell_mesh.h"
#include "svg_detail.h"
#include "svg_gradient.h"
#include "svg_outline.h"

namespace quadrille {

/// A part of a patch that one fill serves.
struct SvgCell {
  PatchCell part;
  CellSamples samples;
  double cost = 0;  ///< squared error and price of the bytes, in the units of SvgDetail::price
};

/// Divides a patch into cells so that about the least squared error remains for the bytes that they
/// take at the price of the detail; colours count by their alpha.
std::vector<SvgCell> divide_into_cells(const SvgLayer& layer, int quad, CellPaint paint,
                                       const SvgDetail& detail);

/// The price of a byte for cells that show this.
double price_of(const SvgDetail& detail, CellPaint paint);

/// The fill of a cell or of several together, with their outlines, and what it costs, where a byte
/// costs `price`; about the best fill where that costs less than `limit`. Errors and costs are in
/// the units of SvgDetail::price; coordinates are multiples of 1 / units_per_pixel pixel.
struct PricedFill {
  CellFill fill;
  double error = 0, cost = 0;
};
PricedFill priced_fill(const std::vector<SvgOutline>& outlines, const CellSamples& samples,
                       double price, int units_per_pixel,
                       double limit = std::numeric_limits<double>::max());

}  // namespace quadrille
