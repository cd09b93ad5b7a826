#pragma once

#include "quadrille/raster.h"

namespace quadrille {

/// The copy of the picture on which the fields are solved. A working pixel is about 1/5 of the quad
/// edge that the fields are made for, so that the cost follows the quads; it is coarser or, for
/// small pictures with many quads, finer than a source pixel.
struct WorkingPicture {
  Raster picture;      ///< sRGB-encoded; colours premultiplied when it has alpha
  double scale_x = 1;  ///< source pixels per working pixel, horizontally
  double scale_y = 1;  ///< source pixels per working pixel, vertically
};

/// `edge` is the length of the lattice edge in source pixels, > 0.
WorkingPicture make_working_picture(const Raster& picture, double edge);

}  // namespace quadrille
