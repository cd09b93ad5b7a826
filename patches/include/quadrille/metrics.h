#pragma once

#include "quadrille/raster.h"

namespace quadrille {

/// Differences between two pictures of equal size, both rounded to 8-bit sRGB, alpha composited
/// over white.
struct ImageDifference {
  double mae = 0;   ///< mean |difference| over pixels and R, G, B, in 0..255
  double psnr = 0;  ///< dB over all pixels and channels; 99 for identical pictures
  double ssim = 0;  ///< mean structural similarity over channels: uniform 7 x 7 window inside the
                    ///< picture, sample covariance, K1 = 0.01, K2 = 0.03 (as scikit-image's
                    ///< default); 1 for identical pictures; NaN when a side is below 7
  double max_error = 0;  ///< largest single difference, in 0..255
};

/// Throws Error{invalid_argument} when the sizes differ.
ImageDifference compare(const Raster& a, const Raster& b);

}  // namespace quadrille
