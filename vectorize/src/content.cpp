#include "quadrille/content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace quadrille {
namespace {

constexpr double kMainShare = 0.9;
constexpr int kKeptBits = 5;

std::uint32_t to_byte(float value) {
  return static_cast<std::uint32_t>(std::floor(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f));
}

/// Red, green, blue and alpha in one number; all transparent pixels are alike.
std::uint32_t packed(const float* pixel, bool has_alpha) {
  const std::uint32_t alpha = has_alpha ? to_byte(pixel[3]) : 255;
  if (alpha == 0) return 0;
  return to_byte(pixel[0]) << 24 | to_byte(pixel[1]) << 16 | to_byte(pixel[2]) << 8 | alpha;
}

std::uint32_t coarse_color(std::uint32_t pixel) {
  const auto channel = [&](int shift) { return (pixel >> (shift + 8 - kKeptBits)) & 31; };
  return channel(24) << 2 * kKeptBits | channel(16) << kKeptBits | channel(8);
}

/// How many of the largest counts add up to the main share of all.
int main_count(std::vector<long long> counts) {
  std::ranges::sort(counts, std::greater());
  long long rest = 0;
  for (const long long count : counts) rest += count;
  const double allowed_rest = (1 - kMainShare) * static_cast<double>(rest);
  int used = 0;
  while (static_cast<double>(rest) > allowed_rest) rest -= counts[used++];
  return used;
}

}  // namespace

Content classify_content(const Raster& picture) {
  check_raster(picture);
  const int w = picture.width, h = picture.height;
  const auto row_of = [&](int y) {
    std::vector<std::uint32_t> row(w);
    for (int x = 0; x < w; ++x) row[x] = packed(picture.pixel(x, y), picture.has_alpha());
    return row;
  };
  long long visible = 0, flat = 0;
  std::vector<long long> counts(std::size_t{1} << 3 * kKeptBits);
  std::vector<std::uint32_t> row = row_of(0);
  for (int y = 0; y < h; ++y) {
    std::vector<std::uint32_t> below = y + 1 < h ? row_of(y + 1) : row;
    for (int x = 0; x < w; ++x) {
      if (row[x] == 0) continue;
      ++visible;
      ++counts[coarse_color(row[x])];
      flat += row[x] == below[x] && row[x] == row[std::min(x + 1, w - 1)];
    }
    row = std::move(below);
  }

  Content content;
  content.width = w;
  content.height = h;
  content.flat_share = visible > 0 ? static_cast<double>(flat) / static_cast<double>(visible) : 1;
  content.main_colors = main_count(std::move(counts));
  content.transparent_share = 1 - static_cast<double>(visible) / w / h;
  return content;
}

}  // namespace quadrille
