#pragma once

#include <functional>

#include "grid_decomposition.h"
#include "placed_grid.h"
#include "svg_outline.h"

namespace quadrille {

/// The outline of a grid, clockwise from its upper left corner. Where `goes_under(h)` says so of a
/// half-edge h of the grid's border, it lies up to `bleed` pixels farther out, in the quad beyond;
/// elsewhere it is exact.
SvgOutline grid_outline(const Layer& layer, const QuadGrid& grid, const PlacedGrid& placed,
                        double bleed, const std::function<bool(int)>& goes_under);

}  // namespace quadrille
