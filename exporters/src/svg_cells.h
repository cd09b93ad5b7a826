#pragma once

#include <vector>

#include "quadrille/bicubic.h"
#include "quadrille/patch_mesh.h"
#include "subdivision.h"
#include "svg_gradient.h"

namespace quadrille {

/// A part of a patch that one gradient paints well enough.
struct SvgCell {
  ParameterBox box;
  GradientFill fill;
};

/// What cells show: the colour itself, or alpha as gray for a mask.
enum class CellPaint { color, alpha };

/// Divides a patch until each cell's fill is within the tolerance (8-bit steps; colours count by
/// their alpha) or the cell is too small to matter. Cells come in an order in which each one may be
/// painted on over everything to its right and below in (u, v): those cells follow it.
std::vector<SvgCell> divide_into_cells(const BicubicHermite<Eigen::Vector2d>& geometry,
                                       const BicubicHermite<Color>& color, CellPaint paint,
                                       double tolerance);

}  // namespace quadrille
