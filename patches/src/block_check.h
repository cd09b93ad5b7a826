#pragma once

#include <memory>
#include <span>

#include "block_paint.h"
#include "point_shader.h"

namespace quadrille {

class PatchShader;

/// Compares blocks' polynomials with Newton's method at samples; one for each thread.
class BlockCheck {
 public:
  BlockCheck();

  /// Whether at the samples `inside` the plan's last block, of side kBlockSides[2], no colour
  /// differs by more than 1/170 of an 8-bit step: by less than 1/100 from the truth then, with what
  /// Newton's method may be off.
  bool passes(PatchShader& shader, const BlockPlan& plan, std::span<const SampleSpan> inside);

 private:
  static constexpr int kSide = kBlockSides[2];

  std::unique_ptr<ColorBatch> points_;
  PointRun runs_[ColorBatch::kRuns];
  float painted_[4][kSide * kSide] = {};
  SamplePlanes planes_;
};

}  // namespace quadrille
