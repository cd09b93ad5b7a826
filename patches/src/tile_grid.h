#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "layer_scene.h"
#include "output_frame.h"

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

/// All layers, ready to be scanned where the frame's region is.
std::vector<LayerScene> prepare_layers(const VectorImage& image, const OutputFrame& frame);

/// Calls body(tile, worker) for all tiles, with a worker of its own for every thread, and reports
/// progress as stage "render".
template <class Worker, class Body>
void for_each_tile(const TileGrid& grid, const RunContext& context, const Body& body) {
  tbb::enumerable_thread_specific<Worker> workers;
  std::mutex reporting;
  std::size_t done = 0;
  // More threads than the machine has would only make oneTBB print a warning.
  const int available = tbb::info::default_concurrency();
  tbb::task_arena arena(context.threads > 0 ? std::min(context.threads, available) : available);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t index) {
      body(grid.tile(index), workers.local());
      const std::lock_guard lock(reporting);
      context.progress("render", static_cast<double>(++done) / static_cast<double>(grid.size()));
    });
  });
}

}  // namespace quadrille
