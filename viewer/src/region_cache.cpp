#include "region_cache.h"

#include <algorithm>

namespace quadrille::viewer {
namespace {

bool is_empty(const PixelRegion& r) { return r.width <= 0 || r.height <= 0; }

std::size_t offset_of(const PixelRegion& buffer, int x, int y) {
  return 4 * (static_cast<std::size_t>(y - buffer.y) * buffer.width + (x - buffer.x));
}

}  // namespace

PixelRegion intersection(const PixelRegion& a, const PixelRegion& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

bool contains(const PixelRegion& outer, const PixelRegion& inner) {
  return is_empty(inner) || intersection(outer, inner) == inner;
}

std::vector<PixelRegion> difference(const PixelRegion& whole, const PixelRegion& hole) {
  if (is_empty(hole)) return {whole};
  const int below = hole.y + hole.height, right = hole.x + hole.width;
  std::vector<PixelRegion> parts = {
      {whole.x, whole.y, whole.width, hole.y - whole.y},
      {whole.x, below, whole.width, whole.y + whole.height - below},
      {whole.x, hole.y, hole.x - whole.x, hole.height},
      {right, hole.y, whole.x + whole.width - right, hole.height},
  };
  std::erase_if(parts, is_empty);
  return parts;
}

bool RegionCache::cover(const PixelRegion& needed, const PixelRegion& wished, const Draw& draw) {
  if (contains(region_, needed)) return false;
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(wished.width) * wished.height);
  PixelRegion kept = intersection(region_, wished);
  if (is_empty(kept)) kept = {};
  for (int y = kept.y; y < kept.y + kept.height; ++y) {
    std::copy_n(&pixels_[offset_of(region_, kept.x, y)], 4 * static_cast<std::size_t>(kept.width),
                &pixels[offset_of(wished, kept.x, y)]);
  }
  for (const PixelRegion& part : difference(wished, kept)) {
    draw(part, &pixels[offset_of(wished, part.x, part.y)],
         4 * static_cast<std::ptrdiff_t>(wished.width));
  }
  region_ = wished;
  pixels_ = std::move(pixels);
  return true;
}

void RegionCache::clear() {
  region_ = {};
  pixels_.clear();
}

}  // namespace quadrille::viewer
