#include "quadrille/render.h"

#include <algorithm>
#include <string>

#include "block_painter.h"
#include "output_frame.h"
#include "pixel_writer.h"
#include "tile_grid.h"

namespace quadrille {
namespace {

using ColorSum = Eigen::Array4d;

/// Draws tiles of the output; one for each thread.
class TilePainter {
 public:
  void paint(const std::vector<LayerScene>& scenes, const OutputFrame& frame,
             const PixelRegion& tile, const PixelWriter& writer, Raster& output) {
    const auto pixel = [&](int x, int y) {
      return output.pixel(tile.x + x - frame.region.x, tile.y + y - frame.region.y);
    };
    const SampleWindow window = samples_of(tile, frame.box);
    if (frame.box[0] == 1 && frame.box[1] == 1) {
      const auto samples = blocks_.paint(scenes, window);
      for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) writer.write(samples[y * tile.width + x], pixel(x, y));
      }
      return;
    }
    sums_.assign(std::size_t{1} * tile.width * tile.height, ColorSum::Zero());
    for (int y = window.y_begin; y < window.y_end; y += kBlockSide) {
      for (int x = window.x_begin; x < window.x_end; x += kBlockSide) {
        const SampleWindow part = {x, y, std::min(x + kBlockSide, window.x_end),
                                   std::min(y + kBlockSide, window.y_end)};
        add(blocks_.paint(scenes, part), part, frame.box, tile);
      }
    }
    const double share = 1.0 / frame.box[0] / frame.box[1];
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        writer.write((sums_[y * tile.width + x] * share).cast<float>(), pixel(x, y));
      }
    }
  }

 private:
  BlockPainter blocks_;
  std::vector<ColorSum> sums_;

  /// Adds the samples to the sums of their pixels.
  void add(std::span<const Color> samples, const SampleWindow& part, const std::array<int, 2>& box,
           const PixelRegion& tile) {
    std::size_t i = 0;
    for (int y = part.y_begin; y < part.y_end; ++y) {
      ColorSum* const row = sums_.data() + (y / box[1] - tile.y) * tile.width;
      for (int x = part.x_begin; x < part.x_end; ++x) {
        row[x / box[0] - tile.x] += samples[i++].cast<double>();
      }
    }
  }
};

}  // namespace

Raster render(const VectorImage& image, const RenderOptions& options, const RunContext& context) {
  const OutputFrame frame = output_frame(image, options);
  const bool opaque = image.opaque() || options.background[3] >= 1;
  const PixelWriter writer(options.background, opaque ? 3 : 4);
  const auto scenes = prepare_layers(image, frame);
  Raster output(frame.region.width, frame.region.height, opaque ? 3 : 4);
  for_each_tile<TilePainter>(TileGrid(frame), context,
                             [&](const PixelRegion& tile, TilePainter& painter) {
                               painter.paint(scenes, frame, tile, writer, output);
                             });
  return output;
}

}  // namespace quadrille
