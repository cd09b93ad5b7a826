#pragma once

#include <array>

#include "output_frame.h"
#include "patch_bins.h"

namespace quadrille {

/// The samples of a rectangle of output pixels.
SampleWindow samples_of(const PixelRegion& r, const std::array<int, 2>& box);

/// The frame's region in tiles on an absolute grid: as many output pixels as a block of samples
/// holds, at least one.
class TileGrid {
 public:
  explicit TileGrid(const OutputFrame& frame);

  std::size_t size() const { return std::size_t{1} * columns_ * rows_; }
  /// The tile's pixels inside the region.
  PixelRegion tile(std::size_t index) const;

 private:
  PixelRegion region_;
  std::array<int, 2> side_, first_;
  int columns_, rows_;
};

}  // namespace quadrille
