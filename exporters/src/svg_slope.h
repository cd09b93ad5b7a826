#pragma once

#include <Eigen/Core>

#include "quadrille/bicubic.h"
#include "quadrille/vector_image.h"
#include "svg_detail.h"

namespace quadrille {

/// The gradients in the picture of what a patch shows at u, v: one row per channel, in 8-bit steps
/// per pixel, of straight colours; three times that of alpha where alpha is painted. No row is
/// longer than 255; zero where the patch has no area.
Eigen::Matrix<double, 3, 2> paint_slopes(const BicubicHermite<Eigen::Vector2d>& position,
                                         const BicubicHermite<Color>& color, CellPaint paint,
                                         double u, double v);

}  // namespace quadrille
