#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "patch_scan.h"

namespace quadrille {

/// Samples are cut into square blocks on absolute grids, in each of which a patch's colours are
/// bicubic polynomials of the sample's position wherever that is exact enough.
constexpr int kBlockSides[] = {32, 16, 8};

/// How the samples of one patch get their colours.
struct BlockPlan {
  /// A block whose polynomials are good enough. `full` where all its samples are the patch's;
  /// otherwise `coverage` is where its rows begin. `clamped` where colours may leave [0, alpha].
  struct Block {
    int x, y, side;
    bool full, clamped;
    std::uint32_t coverage;
  };
  static constexpr int kTerms = 16;

  std::vector<Block> blocks;
  /// Each block's colours before clamping, as Chebyshev series: see make_series(). kTerms for each
  /// channel, of which there are three where the patch is opaque, otherwise four.
  std::vector<float> series;
  /// A word for each row of a block that is not full; bit i stands for the sample in column i.
  std::vector<std::uint32_t> rows;
  /// The samples in none of the blocks. Without blocks the list stays empty and means all samples.
  std::vector<SampleSpan> points;

  void clear() {
    blocks.clear();
    series.clear();
    rows.clear();
    points.clear();
  }
  std::size_t bytes() const {
    return blocks.size() * sizeof(Block) + series.size() * sizeof(float) +
           rows.size() * sizeof(rows[0]) + points.size() * sizeof(SampleSpan);
  }
};

/// The plans of those patches of a scene that were asked for so far, kept from window to window.
class KeptPlans {
 public:
  void start(std::size_t patch_count) { plans_.assign(patch_count, {}); }
  bool has(int patch) const { return plans_[patch].known; }
  void set(int patch, BlockPlan plan) { plans_[patch] = {std::move(plan), true}; }
  const BlockPlan& of(int patch) const { return plans_[patch].plan; }

 private:
  struct Entry {
    BlockPlan plan;
    bool known = false;
  };
  std::vector<Entry> plans_;  // #Q
};

}  // namespace quadrille
