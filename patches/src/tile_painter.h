#pragma once

#include <vector>

#include "block_painter.h"
#include "output_frame.h"
#include "tile_grid.h"

namespace quadrille {

/// Draws tiles of the output; one for each thread.
class TilePainter {
 public:
  /// The tile's premultiplied pixels, valid until the next call.
  const SamplePlanes& paint(const std::vector<LayerScene>& scenes, const OutputFrame& frame,
                            const PixelRegion& tile, bool with_alpha);
  /// The tile's 8-bit pixels of a single opaque layer, where pixels are samples.
  PixelWords paint_words(const LayerScene& scene, const PixelRegion& tile,
                         const PixelPacker& packer) {
    return blocks_.paint_words(scene, samples_of(tile, {1, 1}), packer);
  }

 private:
  BlockPainter blocks_;
  std::vector<double> sums_;   // of the tile's pixels, plane by plane
  std::vector<float> memory_;  // of means_
  SamplePlanes means_;

  void add(const SamplePlanes& samples, const SampleWindow& part, const std::array<int, 2>& box,
           const PixelRegion& tile);
};

}  // namespace quadrille
