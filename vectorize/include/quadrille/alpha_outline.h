#pragma once

#include <vector>

#include "quadrille/planar_loops.h"
#include "quadrille/raster.h"

namespace quadrille {

/// Alpha from which on a pixel counts as opaque.
inline constexpr float kOpaqueAlpha = 0.5f;

/// The border of a picture's opaque part: where the alpha of the pixel centres, interpolated along
/// rows and columns, passes kOpaqueAlpha (marching squares), and the picture's frame where opaque
/// pixels touch it. Loops run with the opaque part on their positive side, in source pixels; their
/// points are multiples of 1/64 pixel, and the loops are simple and disjoint. Where four pixels
/// meet diagonally the opaque ones join when the mean of their alpha is kOpaqueAlpha or more.
///
/// Loops whose area is below `least_area` square pixels are left out, components and holes alike,
/// but never the largest one. Empty when no pixel is opaque; the frame for a picture without alpha.
/// Throws Error{invalid_argument} for a malformed picture.
std::vector<Loop> alpha_outline(const Raster& picture, double least_area = 0);

/// True for a single loop along the sides of the rectangle [0, width] x [0, height] that leaves out
/// at most `least_area` square pixels.
bool is_frame(const std::vector<Loop>& outline, double width, double height, double least_area = 0);

}  // namespace quadrille
