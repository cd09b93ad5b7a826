#include "block_check.h"

#include <cmath>

#include "patch_shader.h"

namespace quadrille {

BlockCheck::BlockCheck() : points_(std::make_unique<ColorBatch>()) {
  for (int k = 0; k < 4; ++k) planes_.channel[k] = painted_[k];
  planes_.stride = kSide;
}

bool BlockCheck::passes(PatchShader& shader, const BlockPlan& plan,
                        std::span<const SampleSpan> inside) {
  constexpr float kAllowed = 1.0f / 170 / 255;
  points_->count = 0;
  const BlockPlan::Block& block = plan.blocks.back();
  const SampleWindow window = {block.x, block.y, block.x + kSide, block.y + kSide};
  const int count =
      append_spans(inside, shader.origin(), {block.x, block.y}, kSide, *points_, runs_);
  if (!shader.shade_found(*points_)) return false;
  paint_blocks(plan, plan.blocks.size() - 1, plan.blocks.size(), shader.opaque(), window, planes_);
  for (int k = 0; k < (shader.opaque() ? 3 : 4); ++k) {
    for (int r = 0; r < count; ++r) {
      const PointRun& run = runs_[r];
      for (int i = 0; i < run.count; ++i) {
        const float off = painted_[k][run.target + i] - points_->color[k][run.begin + i];
        if (!(std::abs(off) <= kAllowed)) return false;
      }
    }
  }
  return true;
}

}  // namespace quadrille
