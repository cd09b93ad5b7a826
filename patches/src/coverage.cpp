#include <algorithm>
#include <cstdint>
#include <mutex>

#include "layer_scene.h"
#include "quadrille/render.h"
#include "tile_grid.h"

namespace quadrille {
namespace {

/// Counts the coverage of a tile.
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
  WorkArena arena;
  arena.set_threads(context);
  std::vector<LayerScene> scenes;
  for (const Layer& layer : image.layers) {
    scenes.emplace_back(layer, arena)
        .prepare(frame.scale, samples_of(frame.region, frame.box), arena);
  }
  const TileGrid grid(frame);
  std::mutex adding;
  CoverageReport total;
  std::size_t done = 0;
  arena.for_each(grid.size(), [&](std::size_t index) {
    const CoverageReport part =
        CoverageCounter().count(scenes, samples_of(grid.tile(index), frame.box));
    const std::lock_guard lock(adding);
    total.uncovered += part.uncovered;
    total.doubly_covered += part.doubly_covered;
    context.progress("coverage", static_cast<double>(++done) / static_cast<double>(grid.size()));
  });
  return total;
}

}  // namespace quadrille
