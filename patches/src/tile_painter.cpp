#include "tile_painter.h"

#include <algorithm>

namespace quadrille {

const SamplePlanes& TilePainter::paint(const std::vector<LayerScene>& scenes,
                                       const OutputFrame& frame, const PixelRegion& tile,
                                       bool with_alpha) {
  const SampleWindow window = samples_of(tile, frame.box);
  if (frame.box[0] == 1 && frame.box[1] == 1) return blocks_.paint(scenes, window, with_alpha);

  const std::size_t pixels = std::size_t{1} * tile.width * tile.height;
  const std::size_t channels = with_alpha ? 4 : 3;
  sums_.assign(channels * pixels, 0.0);
  for (int y = window.y_begin; y < window.y_end; y += kBlockSide) {
    for (int x = window.x_begin; x < window.x_end; x += kBlockSide) {
      const SampleWindow part = {x, y, std::min(x + kBlockSide, window.x_end),
                                 std::min(y + kBlockSide, window.y_end)};
      add(blocks_.paint(scenes, part, with_alpha), part, frame.box, tile);
    }
  }
  memory_.resize(channels * pixels + ColorBatch::kPadding);
  const double share = 1.0 / frame.box[0] / frame.box[1];
  for (std::size_t i = 0; i < channels * pixels; ++i) {
    memory_[i] = static_cast<float>(sums_[i] * share);
  }
  for (std::size_t k = 0; k < channels; ++k) means_.channel[k] = memory_.data() + k * pixels;
  means_.stride = tile.width;
  means_.has_alpha = with_alpha;
  return means_;
}

/// Adds the samples to the sums of their pixels.
void TilePainter::add(const SamplePlanes& samples, const SampleWindow& part,
                      const std::array<int, 2>& box, const PixelRegion& tile) {
  const std::size_t pixels = std::size_t{1} * tile.width * tile.height;
  const int width = part.x_end - part.x_begin;
  const int run = std::min(box[0], width);  // samples of one pixel in a row of the part
  for (std::size_t k = 0; k * pixels < sums_.size(); ++k) {
    for (int y = part.y_begin; y < part.y_end; ++y) {
      const float* const row = samples.channel[k] + (y - part.y_begin) * samples.stride;
      double* const sums = sums_.data() + k * pixels +
                           std::size_t{1} * (y / box[1] - tile.y) * tile.width +
                           (part.x_begin / box[0] - tile.x);
      for (int x = 0; x < width; x += run) {
        float sum = row[x];
        for (int i = 1; i < run; ++i) sum += row[x + i];
        sums[x / run] += sum;
      }
    }
  }
}

}  // namespace quadrille
