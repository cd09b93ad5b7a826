#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "block_colors.h"

namespace quadrille {

class PatchShader;

/// How the samples of one patch get their colours.
struct BlockPlan {
  /// A block whose polynomials are good enough, and the patch's spans [begin, end) in its rows.
  struct Block {
    int x, y, side, begin, end;
    BlockNodes nodes;
  };
  std::vector<Block> blocks;
  /// The samples in none of them. Without blocks the list stays empty and means all samples.
  std::vector<SampleSpan> points;
};

/// Finds the largest blocks on the absolute grids that are good enough; one for each thread.
class BlockPlanner {
 public:
  /// Of a patch with these bounds for some of its spans, rows in ascending order. What a sample
  /// gets does not depend on the other spans.
  void plan(const PatchShader& shader, const SampleWindow& bounds,
            std::span<const SampleSpan> spans, BlockPlan& plan);

 private:
  static constexpr int kSmallest = kBlockSides[2];
  /// The spans of some rows and the range of columns that they reach into.
  struct Band {
    int begin, end, x_begin, x_end;
  };
  /// The first sample of a block.
  struct Corner {
    int x, y;
  };

  std::span<const SampleSpan> spans_;
  int first_band_ = 0;
  std::vector<Band> bands_;         // of rows as high as the smallest blocks
  std::vector<Corner> tried_;       // blocks
  std::vector<ColorBlock> blocks_;  // those tried
  std::vector<std::uint8_t> fit_;

  void find_bands();
  void start(int largest);
  Band spans_in(const Corner& corner, int side) const;
  void take_fitting(const PatchShader& shader, int side, BlockPlan& plan);
  void take_rest(BlockPlan& plan) const;
};

/// The plans of those patches of a scene that were asked for so far, kept from window to window.
class KeptPlans {
 public:
  void start(std::size_t patch_count) { plans_.assign(patch_count, {}); }
  bool has(int patch) const { return plans_[patch].known; }
  void set(int patch, BlockPlan plan) { plans_[patch] = {std::move(plan), true}; }
  std::size_t bytes(int patch) const {
    const BlockPlan& plan = plans_[patch].plan;
    return plan.blocks.size() * sizeof(BlockPlan::Block) + plan.points.size() * sizeof(SampleSpan);
  }
  const BlockPlan& of(int patch) const { return plans_[patch].plan; }

 private:
  struct Entry {
    BlockPlan plan;
    bool known = false;
  };
  std::vector<Entry> plans_;  // #Q
};

}  // namespace quadrille
