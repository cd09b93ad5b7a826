#pragma once

#include "quadrille/raster.h"

namespace quadrille::bench {

/// Mean absolute difference, in 0..255 over white as compare() shows pictures, at the original's
/// edges: the 5 % of its pixels with the largest gradient (Sobel on the mean of red, green and
/// blue), without those whose gradient is zero. NaN for a picture of one colour.
double edge_error(const Raster& original, const Raster& other);

}  // namespace quadrille::bench
