#pragma once

#include "vips_image.h"

namespace quadrille {

/// The colours of a picture of 8 or 16 bits without alpha as sRGB: three bands of 8 or 16 bits. An
/// embedded ICC profile is applied (relative colorimetric with black point compensation) unless it
/// describes sRGB itself, in which case the samples stay as they are; one that cannot be applied is
/// ignored. CMYK without a profile takes the one that comes with libvips.
/// Null, with libvips' error set, when there is no way to sRGB.
VipsImagePtr to_srgb(VipsImage* colors);

}  // namespace quadrille
