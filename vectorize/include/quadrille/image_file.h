#pragma once

#include <filesystem>

#include "quadrille/raster.h"

namespace quadrille {

struct ImageLimits {
  /// Pictures with more pixels than this are refused before anything is decoded.
  long long max_pixels = 300'000'000;
};

/// Reads a PNG, JPEG, WebP, TIFF, GIF, AVIF, PPM or any other file that libvips reads, by content
/// and not by name: 8 or 16 bit, gray, palette, alpha; CMYK and pictures with an ICC profile are
/// converted to sRGB; the EXIF rotation is applied. The first page of several. RGB when every alpha
/// is 1, RGBA otherwise.
/// Throws Error{io_failure} for a missing, unreadable, truncated or damaged file,
/// Error{unsupported_format} for content that is not a picture, Error{limit_exceeded} for too many
/// pixels. Each message is one sentence that names the file, the reason and what to do.
Raster load_image(const std::filesystem::path& path, const ImageLimits& limits = {});

}  // namespace quadrille
