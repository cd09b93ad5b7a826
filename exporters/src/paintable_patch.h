#pragma once

#include "subdivision.h"

namespace quadrille {

/// True when the patch is finite and stays within 1e7 pixels of the picture's origin: others make
/// files that programs refuse, and overflow whole numbers.
bool is_paintable(const BicubicBezier<Eigen::Vector2d>& position,
                  const BicubicBezier<Color>& color);

/// The same for a patch of a layer, where the layer's transform puts it.
bool is_paintable(const Layer& layer, int quad);

}  // namespace quadrille
