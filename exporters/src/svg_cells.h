#pragma once

#include <vector>

#include "svg_detail.h"
#include "svg_gradient.h"
#include "svg_layer.h"
#include "svg_outline.h"

namespace quadrille {

/// A part of a patch as it is painted.
struct SvgCell {
  SvgOutline outline;
  CellFill fill;
};

/// What cells show: the colour itself, or alpha as gray for a mask.
enum class CellPaint { color, alpha };

/// Divides a patch into cells so that about the least squared error remains for the bytes that they
/// take at the price of the detail; colours count by their alpha. Cells come in the order in which
/// they are to be painted; each one reaches `bleed` pixels under those that follow it.
std::vector<SvgCell> divide_into_cells(const SvgLayer& layer, int quad, CellPaint paint,
                                       const SvgDetail& detail, double bleed);

}  // namespace quadrille
