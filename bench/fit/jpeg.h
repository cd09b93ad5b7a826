#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "quadrille/raster.h"

namespace quadrille::bench {

/// The best JPEG of the picture over white, by libvips with optimised Huffman tables and no
/// metadata, that takes at most so many bytes: its quality (1 to 100), bytes, mae, psnr and ssim.
/// An empty object when quality 1 takes more. Throws Error{io_failure} when libvips fails.
nlohmann::ordered_json jpeg_within(const Raster& picture, std::size_t bytes);

}  // namespace quadrille::bench
