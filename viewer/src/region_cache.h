#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "quadrille/render.h"

namespace quadrille::viewer {

/// The rectangle that two have in common; width or height 0 where there is none.
PixelRegion intersection(const PixelRegion& a, const PixelRegion& b);

/// True when `outer` covers all of `inner`, as it does when that is empty.
bool contains(const PixelRegion& outer, const PixelRegion& inner);

/// The parts of `whole` outside of `hole`, which lies within it: up to four rectangles.
std::vector<PixelRegion> difference(const PixelRegion& whole, const PixelRegion& hole);

/// RGBA bytes of a region of an output. While the view moves, pixels are drawn once.
class RegionCache {
 public:
  /// Draws pixels of a region; straight RGBA bytes.
  using Draw =
      std::function<void(const PixelRegion&, std::uint8_t* pixels, std::ptrdiff_t row_bytes)>;

  /// Sees to it that `needed` is there; when it is not, draws what is missing of `wished`, which
  /// contains `needed`. Returns whether the pixels changed.
  bool cover(const PixelRegion& needed, const PixelRegion& wished, const Draw& draw);
  /// Forgets all pixels: they would look different now.
  void clear();

  const PixelRegion& region() const { return region_; }
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }

 private:
  PixelRegion region_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace quadrille::viewer
