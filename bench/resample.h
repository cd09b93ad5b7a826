#pragma once

#include "quadrille/raster.h"

namespace quadrille::bench {

enum class Interpolation { nearest, bicubic, lanczos };

/// The picture at `factor` >= 1 times its sides, rounded, by OpenCV: its bicubic filter has
/// a = -0.75, its Lanczos filter four lobes. Pixel centres are kept in place, alpha is
/// premultiplied on the way, samples are clamped to [0, 1].
Raster enlarged(const Raster& picture, double factor, Interpolation interpolation);

/// The picture at 1 / factor of its sides: means of factor x factor pixels, alpha premultiplied on
/// the way, rounded to 8 bits as a file would hold them. The sides must be multiples of the factor.
Raster reduced(const Raster& picture, int factor);

}  // namespace quadrille::bench
