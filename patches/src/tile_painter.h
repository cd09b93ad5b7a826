#pragma once

#include <vector>

#include "block_painter.h"
#include "output_frame.h"

namespace quadrille {

/// Draws tiles of the output; one for each thread.
class TilePainter {
 public:
  /// The tile's premultiplied pixels, valid until the next call.
  const SamplePlanes& paint(const std::vector<LayerScene>& scenes, const OutputFrame& frame,
                            const PixelRegion& tile, bool with_alpha);

 private:
  BlockPainter blocks_;
  std::vector<double> sums_;   // of the tile's pixels, plane by plane
  std::vector<float> memory_;  // of means_
  SamplePlanes means_;

  void add(const SamplePlanes& samples, const SampleWindow& part, const std::array<int, 2>& box,
           const PixelRegion& tile);
};

}  // namespace quadrille
