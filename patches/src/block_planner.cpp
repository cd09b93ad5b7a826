#include "block_planner.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bit_range.h"
#include "patch_shader.h"

namespace quadrille {
namespace {

/// Rounded down, also where rows are negative.
int band_of(int y) { return y >> std::countr_zero(static_cast<unsigned>(kBlockSides[2])); }

/// Whether three channels stay in [0, 1], roundings included: no Chebyshev polynomial leaves
/// [-1, 1].
bool stays_within(const float* series) {
  constexpr float kRounding = 1e-5f;
  for (int k = 0; k < 3; ++k, series += BlockPlan::kTerms) {
    float swing = kRounding;
    for (int i = 1; i < BlockPlan::kTerms; ++i) swing += std::abs(series[i]);
    const bool within = series[0] >= swing && series[0] <= 1 - swing;  // false for NaN
    if (!within) return false;
  }
  return true;
}

}  // namespace

void BlockPlanner::plan(const PatchShader& shader, const SampleWindow& bounds,
                        std::span<const SampleSpan> spans, bool complete, BlockPlan& plan) {
  plan.clear();
  if (spans.empty()) return;
  // Blocks fit and pay where a patch is some times larger, wherever the window is cut.
  const std::int64_t least = std::min(std::int64_t{bounds.x_end} - bounds.x_begin,
                                      std::int64_t{bounds.y_end} - bounds.y_begin);
  int largest = kBlockSides[0];
  while (largest >= kSmallest && 2 * largest > least) largest /= 2;
  if (largest < kSmallest) return;
  spans_ = spans;
  complete_ = complete;
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
  first_band_ = band_of(spans_.front().y);
  bands_.assign(band_of(spans_.back().y) - first_band_ + 1, {0, 0, 0, 0});
  for (int i = 0; i < static_cast<int>(spans_.size()); ++i) {
    const SampleSpan& s = spans_[i];
    Band& band = bands_[band_of(s.y) - first_band_];
    if (band.begin == band.end) band = {i, i, s.x_begin, s.x_end};
    band.end = i + 1;
    band.x_begin = std::min(band.x_begin, s.x_begin);
    band.x_end = std::max(band.x_end, s.x_end);
  }
}

/// Tries all blocks of this side that the spans reach into. Patches reach over the picture's left
/// and upper sides, where nothing is drawn.
void BlockPlanner::start(int largest) {
  SampleWindow part = {spans_.front().x_begin, spans_.front().y, spans_.front().x_end,
                       spans_.back().y + 1};
  for (const SampleSpan& s : spans_) {
    part.x_begin = std::min(part.x_begin, s.x_begin);
    part.x_end = std::max(part.x_end, s.x_end);
  }
  tried_.clear();
  for (int y = std::max(part.y_begin, 0) & -largest; y < part.y_end; y += largest) {
    for (int x = std::max(part.x_begin, 0) & -largest; x < part.x_end; x += largest) {
      tried_.push_back({x, y});
    }
  }
}

/// The spans in the block's rows, if any may reach into it, and their columns.
BlockPlanner::Band BlockPlanner::spans_in(const Corner& corner, int side) const {
  const int first = band_of(corner.y) - first_band_;
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

/// The parts of the spans in a block.
void BlockPlanner::find_inside(const Corner& corner, int side) {
  const Band band = spans_in(corner, side);
  inside_.clear();
  for (int i = band.begin; i < band.end; ++i) {
    const SampleSpan& s = spans_[i];
    const int begin = std::max(s.x_begin, corner.x), end = std::min(s.x_end, corner.x + side);
    if (begin < end) inside_.push_back({s.y, begin, end});
  }
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
    find_inside(c, side);
    if (inside_.empty() || take(shader, i, side, plan)) continue;
    tried_[rest++] = c;
  }
  tried_.resize(rest);
}

/// Takes a block tried if it fits.
bool BlockPlanner::take(const PatchShader& shader, std::size_t tried, int side, BlockPlan& plan) {
  const Corner c = tried_[tried];
  find_rows(c, side);
  // Of larger blocks more is proven, and where that fails few would match. Of small parts of blocks
  // the points are cheaper than the series.
  const bool compared = complete_ && side == kSmallest && sample_count_ >= BlockPlan::kTerms;
  if (!fit_[tried] && !compared) return false;
  const ColorBlock& block = blocks_[tried];
  const std::size_t before = plan.series.size();
  plan.series.resize(before + BlockPlan::kTerms * (shader.opaque() ? 3 : 4));
  float* const series = plan.series.data() + before;
  if (!shader.find_series(side, block, series) ||
      !(fit_[tried] || shader.matches(block, series, smallest_samples()))) {
    plan.series.resize(before);
    return false;
  }
  const bool full = sample_count_ == side * side;
  const bool clamped = !(shader.opaque() && stays_within(series));
  plan.blocks.push_back(
      {c.x, c.y, side, full, clamped, static_cast<std::uint32_t>(plan.rows.size())});
  if (!full) plan.rows.insert(plan.rows.end(), rows_, rows_ + side);
  return true;
}

/// Sets the bits of what lies inside a block.
void BlockPlanner::find_rows(const Corner& corner, int side) {
  std::fill_n(rows_, side, 0u);
  sample_count_ = 0;
  for (const SampleSpan& s : inside_) {
    rows_[s.y - corner.y] |= bit_range(s.x_begin - corner.x, s.x_end - corner.x);
    sample_count_ += s.x_end - s.x_begin;
  }
}

/// The bits of one of the smallest blocks.
std::uint64_t BlockPlanner::smallest_samples() const {
  std::uint64_t bits = 0;
  for (int y = 0; y < kSmallest; ++y) bits |= std::uint64_t{rows_[y]} << kSmallest * y;
  return bits;
}

/// What lies in the smallest blocks tried.
void BlockPlanner::take_rest(BlockPlan& plan) {
  for (const Corner& c : tried_) {
    find_inside(c, kSmallest);
    plan.points.insert(plan.points.end(), inside_.begin(), inside_.end());
  }
}

}  // namespace quadrille
