#pragma once

#include <vector>

#include "subdivision.h"

namespace quadrille {

/// Farthest that control points of patches may be from the picture's origin, in pixels.
inline constexpr double kFarthestPixel = 1e7;

/// True when the patch is finite and its control points lie within kFarthestPixel: others make
/// files that programs refuse, and overflow whole numbers.
bool is_paintable(const BicubicBezier<Eigen::Vector2d>& position,
                  const BicubicBezier<Color>& color);

/// The same for a patch of a layer, where the layer's transform puts it.
bool is_paintable(const Layer& layer, int quad);

/// The same for each patch of a layer.
std::vector<char> paintable_patches(const Layer& layer);

}  // namespace quadrille
