#pragma once

#include "quadrille/raster.h"

namespace quadrille {

/// The picture with red, green and blue times alpha; `picture` has alpha.
Raster premultiplied(const Raster& picture);

/// Bilinear where it grows, averages over areas where it shrinks; the channels apart.
Raster resized(const Raster& picture, int width, int height);

/// The picture with both sides divided by `factor`, rounded: averages over areas, alpha straight.
Raster reduced_picture(const Raster& picture, double factor);

}  // namespace quadrille
