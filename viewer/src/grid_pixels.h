#pragma once

#include <Eigen/Core>

#include "quadrille/scene_layer.h"
#include "region_cache.h"

namespace quadrille::viewer {

/// Draws the colours of a grid over a region of an output of `scale` output pixels per source
/// pixel: pixels of the grid are squares, and where they are smaller than the output's, the mean of
/// k x k samples weighed by alpha, k = ceil(pixels of the grid per output pixel). Nothing where the
/// grid has no colours.
void draw_grid(const SceneGrid& grid, const SceneStyle& style, const Eigen::Array2d& scale,
               const PixelRegion& region, std::uint8_t* pixels, std::ptrdiff_t row_bytes);

}  // namespace quadrille::viewer
