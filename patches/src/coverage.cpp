#include <algorithm>
#include <cstdint>

#include "quadrille/render.h"
#include "tile_grid.h"

namespace quadrille {
namespace {

/// Counts the coverage of tiles; one for each thread.
class CoverageCounter {
 public:
  CoverageReport count(const std::vector<LayerScene>& scenes, const SampleWindow& window) {
    const std::size_t width = window.x_end - window.x_begin;
    const std::size_t size = width * (window.y_end - window.y_begin);
    seen_.assign(size, 0);
    doubled_.assign(size, 0);
    for (const LayerScene& scene : scenes) {
      seen_by_layer_.assign(size, 0);
      for (const int q : scene.patches_at(window)) {
        scene.scan().scan(q, window, [&](int y, int x_begin, int x_end) {
          const std::size_t row = (y - window.y_begin) * width - window.x_begin;
          for (int x = x_begin; x < x_end; ++x) {
            doubled_[row + x] |= seen_by_layer_[row + x];
            seen_by_layer_[row + x] = seen_[row + x] = 1;
          }
        });
      }
    }
    CoverageReport report;
    report.uncovered = std::count(seen_.begin(), seen_.end(), 0);
    report.doubly_covered = std::count(doubled_.begin(), doubled_.end(), 1);
    return report;
  }

 private:
  std::vector<std::uint8_t> seen_, seen_by_layer_, doubled_;
};

}  // namespace

CoverageReport count_coverage(const VectorImage& image, const RenderOptions& options,
                              const RunContext& context) {
  RenderOptions whole = options;
  whole.region.reset();
  OutputFrame frame = output_frame(image, whole);
  // One sample per pixel, whatever the scale.
  for (int axis = 0; axis < 2; ++axis) frame.scale[axis] /= frame.box[axis];
  frame.box = {1, 1};
  const auto scenes = prepare_layers(image, frame);
  std::mutex adding;
  CoverageReport total;
  for_each_tile<CoverageCounter>(
      TileGrid(frame), context, [&](const PixelRegion& tile, CoverageCounter& counter) {
        const CoverageReport part = counter.count(scenes, samples_of(tile, frame.box));
        const std::lock_guard lock(adding);
        total.uncovered += part.uncovered;
        total.doubly_covered += part.doubly_covered;
      });
  return total;
}

}  // namespace quadrille
