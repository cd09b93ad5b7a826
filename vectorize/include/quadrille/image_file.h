#pragma once

#include <filesystem>

#include "quadrille/raster.h"

namespace quadrille {

struct ImageLimits {
  /// Pictures with more pixels than this are refused before anything is decoded.
  long long max_pixels = 300'000'000;
};

/// Reads a PNG, JPEG, WebP, TIFF, GIF, AVIF, HEIF, JPEG 2000, JPEG XL or PPM file, by content and
/// not by name: 8 or 16 bits of gray, palette, RGB or CMYK, with or without alpha. Pictures with an
/// ICC profile and CMYK are converted to sRGB (to 16 bits), unless the profile describes sRGB
/// within two 8-bit steps, in which case the samples stay as they are; the EXIF rotation is
/// applied. The first page of several. RGB when every alpha is 1, RGBA otherwise. Throws
/// Error{io_failure} for a missing, unreadable, truncated or damaged file,
/// Error{unsupported_format} for content that is not such a picture, Error{limit_exceeded} for too
/// many pixels. Each message is one sentence that names the file, the reason and what to do.
Raster load_image(const std::filesystem::path& path, const ImageLimits& limits = {});

}  // namespace quadrille
