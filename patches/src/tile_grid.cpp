#include "tile_grid.h"

#include <algorithm>

namespace quadrille {

SampleWindow samples_of(const PixelRegion& r, const std::array<int, 2>& box) {
  return {r.x * box[0], r.y * box[1], (r.x + r.width) * box[0], (r.y + r.height) * box[1]};
}

TileGrid::TileGrid(const OutputFrame& frame) : region_(frame.region) {
  const PixelRegion& r = region_;
  side_ = {std::max(1, kBlockSide / frame.box[0]), std::max(1, kBlockSide / frame.box[1])};
  first_ = {r.x / side_[0], r.y / side_[1]};
  columns_ = (r.x + r.width - 1) / side_[0] + 1 - first_[0];
  rows_ = (r.y + r.height - 1) / side_[1] + 1 - first_[1];
}

PixelRegion TileGrid::tile(std::size_t index) const {
  const PixelRegion& r = region_;
  const int left = (first_[0] + static_cast<int>(index % columns_)) * side_[0];
  const int top = (first_[1] + static_cast<int>(index / columns_)) * side_[1];
  const int x = std::max(left, r.x), y = std::max(top, r.y);
  return {x, y, std::min(left + side_[0], r.x + r.width) - x,
          std::min(top + side_[1], r.y + r.height) - y};
}

}  // namespace quadrille
