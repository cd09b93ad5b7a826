#include "growth.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "front_half.h"
#include "own_process.h"
#include "process_cost.h"
#include "quadrille/image_file.h"
#include "resample.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kPixelsPerQuad = 481.0 * 321 / 3000;
constexpr double kLargePixels = 12e6;

/// The factor that gives the picture so many pixels; 1 when it has them.
double enlargement(const Raster& picture, double pixels) {
  return std::max(1.0, std::sqrt(pixels / picture.width / picture.height));
}

/// `factor` tells from the picture how far to enlarge it.
template <class Factor>
TableRow measure(const fs::path& path, const FrontHalfOptions& options, const Factor& factor) {
  Json json = run_in_own_process([&] {
    const Raster original = load_image(path);
    const Raster picture = enlarged(original, factor(original), Interpolation::bicubic);
    Json figures = measure_front_half(picture, options).figures;
    figures["size"] = fmt::format("{}x{}", picture.width, picture.height);
    figures["peak_mb"] = peak_megabytes();
    figures["ms_per_1000_quads"] = 1e6 * figures["cpu"].get<double>() / figures["quads"].get<int>();
    figures["us_per_pixel"] = 1e6 * figures["cpu"].get<double>() / picture.width / picture.height;
    return figures;
  });
  return {fmt::format("{} quads", options.quads), std::move(json)};
}

}  // namespace

std::vector<TableRow> growth_with_quads(const fs::path& picture, int threads) {
  std::vector<TableRow> rows;
  for (const int quads : {100, 1000, 3000, 10'000, 30'000, 100'000}) {
    rows.push_back(measure(picture, {quads, threads}, [&](const Raster& original) {
      return enlargement(original, kPixelsPerQuad * quads);
    }));
  }
  return rows;
}

std::vector<TableRow> growth_with_pixels(const fs::path& picture, int threads) {
  std::vector<TableRow> rows;
  for (const double factor : {1, 2, 4}) {
    rows.push_back(measure(picture, {3000, threads}, [&](const Raster&) { return factor; }));
  }
  return rows;
}

std::vector<TableRow> large_picture(const fs::path& picture, int threads) {
  return {measure(picture, {50'000, threads},
                  [](const Raster& original) { return enlargement(original, kLargePixels); })};
}

}  // namespace quadrille::bench
