#pragma once

#include <array>
#include <filesystem>

#include "quadrille/raster.h"

namespace quadrille::test {

/// An SVG file as librsvg draws it in this size, on nothing.
Raster drawn_by_librsvg(const std::filesystem::path& svg, const std::array<int, 2>& size);

}  // namespace quadrille::test
