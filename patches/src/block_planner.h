#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "block_colors.h"
#include "block_plan.h"

namespace quadrille {

class PatchShader;

/// Finds the largest blocks on the absolute grids that are good enough; one for each thread.
class BlockPlanner {
 public:
  /// Of a patch with these bounds for some of its spans, rows in ascending order. What a sample
  /// gets does not depend on the other spans, unless these are all of the patch: `complete`, which
  /// must not depend on the window.
  void plan(const PatchShader& shader, const SampleWindow& bounds,
            std::span<const SampleSpan> spans, bool complete, BlockPlan& plan);

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
  bool complete_ = false;
  int first_band_ = 0;
  std::vector<Band> bands_;         // of rows as high as the smallest blocks
  std::vector<Corner> tried_;       // blocks
  std::vector<ColorBlock> blocks_;  // those tried
  std::vector<std::uint8_t> fit_;
  std::vector<SampleSpan> inside_;      // a block
  std::uint32_t rows_[kBlockSides[0]];  // of a block: a bit for each sample inside
  int sample_count_ = 0;                // of these bits

  void find_bands();
  void start(int largest);
  Band spans_in(const Corner& corner, int side) const;
  void find_inside(const Corner& corner, int side);
  void find_rows(const Corner& corner, int side);
  std::uint64_t smallest_samples() const;
  void take_fitting(const PatchShader& shader, int side, BlockPlan& plan);
  bool take(const PatchShader& shader, std::size_t tried, int side, BlockPlan& plan);
  void take_rest(BlockPlan& plan);
};

}  // namespace quadrille
