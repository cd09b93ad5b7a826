#include "block_plan.h"

#include <algorithm>

#include "patch_shader.h"

namespace quadrille {

void BlockPlanner::plan(const PatchShader& shader, const SampleWindow& bounds,
                        std::span<const SampleSpan> spans, BlockPlan& plan) {
  plan.blocks.clear();
  plan.points.clear();
  if (spans.empty()) return;
  // Blocks fit and pay where a patch is some times larger, wherever the window is cut.
  const int least = std::min(bounds.x_end - bounds.x_begin, bounds.y_end - bounds.y_begin);
  int largest = kBlockSides[0];
  while (largest >= kSmallest && 2 * largest > least) largest /= 2;
  if (largest < kSmallest) return;
  spans_ = spans;
  find_bands();
  start(largest);
  for (int side = largest;; side /= 2) {
    take_fitting(shader, side, plan);
    if (side == kSmallest) break;
    const int half = side / 2;
    for (std::size_t i = 0, count = tried_.size(); i < count; ++i) {
      const auto [x, y] = tried_[i];
      tried_.insert(tried_.end(), {{x + half, y}, {x, y + half}, {x + half, y + half}});
    }
  }
  if (!plan.blocks.empty()) take_rest(plan);
}

void BlockPlanner::find_bands() {
  first_band_ = spans_.front().y / kSmallest;
  bands_.assign(spans_.back().y / kSmallest - first_band_ + 1, {0, 0, 0, 0});
  for (int i = 0; i < static_cast<int>(spans_.size()); ++i) {
    const SampleSpan& s = spans_[i];
    Band& band = bands_[s.y / kSmallest - first_band_];
    if (band.begin == band.end) band = {i, i, s.x_begin, s.x_end};
    band.end = i + 1;
    band.x_begin = std::min(band.x_begin, s.x_begin);
    band.x_end = std::max(band.x_end, s.x_end);
  }
}

/// Tries all blocks of this side that the spans reach into.
void BlockPlanner::start(int largest) {
  SampleWindow part = {spans_.front().x_begin, spans_.front().y, spans_.front().x_end,
                       spans_.back().y + 1};
  for (const SampleSpan& s : spans_) {
    part.x_begin = std::min(part.x_begin, s.x_begin);
    part.x_end = std::max(part.x_end, s.x_end);
  }
  tried_.clear();
  for (int y = part.y_begin / largest * largest; y < part.y_end; y += largest) {
    for (int x = part.x_begin / largest * largest; x < part.x_end; x += largest) {
      tried_.push_back({x, y});
    }
  }
}

/// The spans in the block's rows, if any may reach into it, and their columns.
BlockPlanner::Band BlockPlanner::spans_in(const Corner& corner, int side) const {
  const int first = corner.y / kSmallest - first_band_;
  const int last = std::min<int>(first + side / kSmallest, static_cast<int>(bands_.size()));
  Band found = {0, 0, 0, 0};
  for (int i = std::max(first, 0); i < last; ++i) {
    const Band& band = bands_[i];
    if (band.begin == band.end || band.x_begin >= corner.x + side || band.x_end <= corner.x) {
      continue;
    }
    if (found.begin == found.end) found = band;
    found.end = band.end;
  }
  return found;
}

/// Takes the blocks tried, of this side, that fit; the others remain.
void BlockPlanner::take_fitting(const PatchShader& shader, int side, BlockPlan& plan) {
  std::erase_if(tried_, [&](const Corner& c) {
    const Band spans = spans_in(c, side);
    return spans.begin == spans.end;
  });
  blocks_.clear();
  for (const Corner& c : tried_) {
    blocks_.push_back({static_cast<float>(c.x - shader.origin()[0]),
                       static_cast<float>(c.y - shader.origin()[1])});
  }
  fit_.resize(std::max(fit_.size(), blocks_.size()));
  shader.judge(side, blocks_, fit_.data());
  std::size_t rest = 0;
  for (std::size_t i = 0; i < tried_.size(); ++i) {
    const Corner c = tried_[i];
    if (fit_[i]) {
      const Band spans = spans_in(c, side);
      plan.blocks.push_back({c.x, c.y, side, spans.begin, spans.end, {}});
      if (shader.find_nodes(side, blocks_[i], plan.blocks.back().nodes)) continue;
      plan.blocks.pop_back();
    }
    tried_[rest++] = c;
  }
  tried_.resize(rest);
}

/// What lies in the smallest blocks tried.
void BlockPlanner::take_rest(BlockPlan& plan) const {
  for (const Corner& c : tried_) {
    const Band band = spans_in(c, kSmallest);
    for (int i = band.begin; i < band.end; ++i) {
      const SampleSpan& s = spans_[i];
      const int begin = std::max(s.x_begin, c.x), end = std::min(s.x_end, c.x + kSmallest);
      if (begin < end) plan.points.push_back({s.y, begin, end});
    }
  }
}

}  // namespace quadrille
