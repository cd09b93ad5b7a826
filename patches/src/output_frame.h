#pragma once

#include <array>

#include "quadrille/render.h"

namespace quadrille {

/// How output pixels and samples lie over the picture.
struct OutputFrame {
  int width = 0, height = 0;         ///< output pixels of the whole
  std::array<int, 2> box = {1, 1};   ///< samples per output pixel across and down, powers of two
  std::array<double, 2> scale = {};  ///< samples per picture pixel
  PixelRegion region;                ///< the part to draw
};

/// Throws what output_size() throws, and Error{invalid_argument} for a region that is not inside
/// the output.
OutputFrame output_frame(const VectorImage& image, const RenderOptions& options);

}  // namespace quadrille
