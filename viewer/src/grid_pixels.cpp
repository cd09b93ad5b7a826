#include "grid_pixels.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace quadrille::viewer {
namespace {

struct Colors {
  std::span<const std::uint8_t> bytes;
  int components = 0;
};

Colors colors_of(const SceneGrid& grid, const SceneStyle& style) {
  const auto array = std::ranges::find(grid.arrays, style.colors, &SceneArray::name);
  if (array == grid.arrays.end()) return {};
  return {std::get<std::vector<std::uint8_t>>(array->values), array->components};
}

/// The grid's columns (or rows) at the samples of output pixels from `first` on, k for each.
std::vector<int> samples(int first, int count, int k, double per_output_pixel, int size) {
  std::vector<int> indices;
  indices.reserve(static_cast<std::size_t>(count) * k);
  for (int x = first; x < first + count; ++x) {
    for (int i = 0; i < k; ++i) {
      const double at = (x + (i + 0.5) / k) * per_output_pixel;
      indices.push_back(std::clamp(static_cast<int>(std::floor(at)), 0, size - 1));
    }
  }
  return indices;
}

/// The mean of the samples in straight RGBA.
std::array<std::uint8_t, 4> mean(const Colors& colors, int width, std::span<const int> columns,
                                 std::span<const int> rows) {
  int sum[3] = {0, 0, 0}, alpha_sum = 0;
  for (const int row : rows) {
    for (const int column : columns) {
      const std::uint8_t* c =
          &colors.bytes[(static_cast<std::size_t>(row) * width + column) * colors.components];
      const int alpha = colors.components == 4 ? c[3] : 255;
      for (int channel = 0; channel < 3; ++channel) sum[channel] += c[channel] * alpha;
      alpha_sum += alpha;
    }
  }
  if (alpha_sum == 0) return {0, 0, 0, 0};
  const int count = static_cast<int>(rows.size() * columns.size());
  const auto rounded = [](int numerator, int denominator) {
    return static_cast<std::uint8_t>((numerator + denominator / 2) / denominator);
  };
  return {rounded(sum[0], alpha_sum), rounded(sum[1], alpha_sum), rounded(sum[2], alpha_sum),
          rounded(alpha_sum, count)};
}

}  // namespace

void draw_grid(const SceneGrid& grid, const SceneStyle& style, const Eigen::Array2d& scale,
               const PixelRegion& region, std::uint8_t* pixels, std::ptrdiff_t row_bytes) {
  constexpr double kMostSamples = 32;  // a side; their sums stay below 2^31
  const Colors colors = colors_of(grid, style);
  if (colors.components == 0) return;
  const double step_x = 1 / (scale.x() * grid.pixel_width);
  const double step_y = 1 / (scale.y() * grid.pixel_height);
  const int k =
      static_cast<int>(std::clamp(std::ceil(std::max(step_x, step_y) - 1e-9), 1.0, kMostSamples));
  const std::vector<int> columns = samples(region.x, region.width, k, step_x, grid.width);
  const std::vector<int> rows = samples(region.y, region.height, k, step_y, grid.height);
  for (int y = 0; y < region.height; ++y) {
    std::uint8_t* out = pixels + y * row_bytes;
    for (int x = 0; x < region.width; ++x, out += 4) {
      const auto c = mean(colors, grid.width, std::span(columns).subspan(x * k, k),
                          std::span(rows).subspan(y * k, k));
      std::ranges::copy(c, out);
    }
  }
}

}  // namespace quadrille::viewer
