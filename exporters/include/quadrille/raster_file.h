#pragma once

#include <filesystem>

#include "quadrille/export.h"
#include "quadrille/raster.h"

namespace quadrille {

/// Writes a raster as it is (only bits, quality and background of the options count), in the format
/// of the ending, tagged as sRGB. Throws Error{unsupported_format} or Error{io_failure}.
void save_raster(const Raster& picture, const std::filesystem::path& path,
                 const RasterFileOptions& options = {});

}  // namespace quadrille
