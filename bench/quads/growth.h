#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "table.h"

namespace quadrille::bench {

// Each measures the front half on enlarged copies of the picture, in a process of its own. A row
// has the members of FrontHalf::figures and size (WxH), peak_mb, ms_per_1000_quads, us_per_pixel;
// or error and nothing else.

/// From 100 to 100,000 quads; the picture is enlarged where a quad would be left with fewer pixels
/// than 3,000 quads have of 481 x 321.
std::vector<TableRow> growth_with_quads(const std::filesystem::path& picture, int threads);

/// The same number of quads on the picture at 1, 2 and 4 times its side.
std::vector<TableRow> growth_with_pixels(const std::filesystem::path& picture, int threads);

/// 50,000 quads on 12 megapixels.
std::vector<TableRow> large_picture(const std::filesystem::path& picture, int threads);

}  // namespace quadrille::bench
