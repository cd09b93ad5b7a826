#include "block_painter.h"

#include <algorithm>
#include <bit>

#include "block_paint.h"
#include "patch_shader.h"

namespace quadrille {
namespace {

constexpr std::size_t kPlane = std::size_t{1} * kBlockSide * kBlockSide;

/// Blocks may begin left of the window and end right of it, and up to seven rows above and below it
/// are stored to without effect.
constexpr int kOverhang = 8 * kBlockSide;

void set_planes(std::vector<float>& memory, SamplePlanes& planes) {
  memory.assign(kOverhang + 4 * kPlane + kOverhang, 0.0f);
  for (int k = 0; k < 4; ++k) planes.channel[k] = memory.data() + kOverhang + k * kPlane;
  planes.stride = kBlockSide;
}

}  // namespace

BlockPainter::BlockPainter()
    : words_memory_(kOverhang + kPlane + kOverhang), points_(std::make_unique<Pending>()) {
  set_planes(memory_[0], picture_);
  set_planes(memory_[1], layer_);
  words_ = {words_memory_.data() + kOverhang, kBlockSide};
}

void BlockPainter::clear(SamplePlanes& planes) {
  planes.has_alpha = with_alpha_;
  for (int k = 0; k < channels(); ++k) {
    for (int y = 0; y < height(); ++y) {
      std::fill_n(planes.channel[k] + y * planes.stride, width(), 0.0f);
    }
  }
}

const SamplePlanes& BlockPainter::paint(const std::vector<LayerScene>& scenes,
                                        const SampleWindow& window, bool with_alpha) {
  window_ = window;
  with_alpha_ = with_alpha;
  as_words_ = false;
  bool first = true;
  for (const LayerScene& scene : scenes) {
    const auto patches = scene.patches_at(window);
    if (patches.empty()) continue;
    layer_.has_alpha = with_alpha_;
    paint_layer(scene, patches);
    if (first) {
      std::swap(picture_, layer_);
    } else {
      merge_layer();
    }
    first = false;
  }
  if (first) clear(picture_);
  return picture_;
}

PixelWords BlockPainter::paint_words(const LayerScene& scene, const SampleWindow& window,
                                     const PixelPacker& packer) {
  window_ = window;
  with_alpha_ = false;
  as_words_ = true;
  layer_.has_alpha = false;
  paint_layer(scene, scene.patches_at(window));
  pack_blank(scene.edges_at(window), packer);
  return words_;
}

/// Puts the layer over the picture.
void BlockPainter::merge_layer() {
  for (int y = 0; y < height(); ++y) {
    const std::ptrdiff_t row = y * layer_.stride;
    const float* const alpha = layer_.channel[3] + row;
    for (int k = 0; k < 4; ++k) {
      const float* const over = layer_.channel[k] + row;
      float* const under = picture_.channel[k] + row;
      for (int x = 0; x < width(); ++x) under[x] = over[x] + under[x] * (1 - alpha[x]);
    }
  }
}

void BlockPainter::paint_layer(const LayerScene& scene, std::span<const int> patches) {
  outlines_.start(scene.scan(), window_);
  BlockEdges& edges = scene.edges_at(window_);
  if (!edges.knows(window_)) find_edges(scene, patches, edges);
  if (with_alpha_ && scene.patches().opaque) {
    std::ranges::fill(points_->colors.color[3], 1.0f);
  }
  // Backwards, so that of patches that overlap the lowest one is seen.
  for (auto q = patches.rbegin(); q != patches.rend(); ++q) paint_interior(scene, *q);
  clear_blank(edges);
  const int left = window_.x_begin & (kBlockSide - 1), top = window_.y_begin & (kBlockSide - 1);
  for (const auto& [patch, begin, end] : edges.patches) {
    seen_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      BlockEdges::Share share = edges.shares[i];
      const int x = share.column - left, y = share.row - top;
      if (x < 0 || x >= width() || y < 0 || y >= height()) continue;
      share.column = static_cast<std::uint8_t>(x);
      share.row = static_cast<std::uint8_t>(y);
      seen_.push_back(share);
    }
    if (seen_.empty()) continue;
    PatchShader shader(scene, patch);
    paint_outline(shader);
  }
  points_->colors.count = 0;
}

/// Works out the edges in the window.
void BlockPainter::find_edges(const LayerScene& scene, std::span<const int> patches,
                              BlockEdges& edges) {
  edges.patches.clear();
  edges.shares.clear();
  const int left = window_.x_begin & -kBlockSide, top = window_.y_begin & -kBlockSide;
  outline_.find(scene.scan(), patches, window_);
  covered_.fill({});
  for (const int q : patches) {
    cover(clipped(all_spans(scene, q)));
    outline_.take(scene.scan(), q, shares_);
    if (shares_.empty()) continue;
    const std::size_t begin = edges.shares.size();
    for (const OutlinePixels::Share& share : shares_) {
      const OutlinePixels::Pixel& p = outline_.pixels()[share.pixel];
      edges.shares.push_back({static_cast<std::uint8_t>(p.x - left),
                              static_cast<std::uint8_t>(p.y - top), share.weight, share.x,
                              share.y});
    }
    edges.patches.push_back({q, begin, edges.shares.size()});
  }
  for (const OutlinePixels::Pixel& p : outline_.pixels()) {
    const int x = p.x - window_.x_begin;
    covered_[p.y - window_.y_begin][x / 64] &= ~(std::uint64_t{1} << x % 64);
  }
  find_blank(edges);
  edges.window = window_;
}

/// Marks the samples of the spans.
void BlockPainter::cover(std::span<const SampleSpan> spans) {
  const auto bits_before = [](int x) {
    return x <= 0 ? 0 : x >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << x) - 1;
  };
  for (const SampleSpan& s : spans) {
    const int begin = s.x_begin - window_.x_begin, end = s.x_end - window_.x_begin;
    for (int i = begin / 64; 64 * i < end; ++i) {
      covered_[s.y - window_.y_begin][i] |=
          bits_before(end - 64 * i) & ~bits_before(begin - 64 * i);
    }
  }
}

/// Lists what is not marked.
void BlockPainter::find_blank(BlockEdges& edges) {
  edges.blank.clear();
  const int left = window_.x_begin & (kBlockSide - 1), top = window_.y_begin & (kBlockSide - 1);
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width();) {
      const std::uint64_t rest = covered_[y][x / 64] >> x % 64;
      if (rest & 1) {
        x += std::countr_one(rest);
        continue;
      }
      const int free = std::min(std::countr_zero(rest), 64 - x % 64);
      const int end = std::min(x + free, width());
      edges.blank.push_back({top + y, left + x, left + end});
      x = end;
    }
  }
}

/// The part in the window of samples relative to the block, relative to the window; empty ranges
/// where there is none.
SampleSpan BlockPainter::clipped(const SampleSpan& blank) const {
  const int left = window_.x_begin & (kBlockSide - 1), top = window_.y_begin & (kBlockSide - 1);
  const int y = blank.y - top;
  if (y < 0 || y >= height()) return {0, 0, 0};
  const int begin = std::max(blank.x_begin - left, 0);
  return {y, begin, std::max(begin, std::min(blank.x_end - left, width()))};
}

void BlockPainter::clear_blank(const BlockEdges& edges) {
  for (const SampleSpan& blank : edges.blank) {
    const SampleSpan s = clipped(blank);
    for (int k = 0; k < channels(); ++k) {
      float* const row = layer_.channel[k] + s.y * layer_.stride;
      std::fill(row + s.x_begin, row + s.x_end, 0.0f);
    }
  }
}

/// What lies in the layer's planes only.
void BlockPainter::pack_blank(const BlockEdges& edges, const PixelPacker& packer) {
  for (const SampleSpan& blank : edges.blank) {
    const SampleSpan s = clipped(blank);
    if (s.x_begin >= s.x_end) continue;
    const std::ptrdiff_t at = s.y * layer_.stride + s.x_begin;
    SamplePlanes part = layer_;
    for (int k = 0; k < 3; ++k) part.channel[k] += at;
    packer.write(part, s.x_end - s.x_begin, 1, reinterpret_cast<std::byte*>(words_.first + at), 0);
  }
}

/// All spans of a patch that are kept, or those in the window.
std::span<const SampleSpan> BlockPainter::all_spans(const LayerScene& scene, int patch) {
  if (scene.spans().has(patch)) return scene.spans().of(patch);
  outlines_.spans(patch, spans_);
  for (SampleSpan& s : spans_) {
    s = {s.y + window_.y_begin, s.x_begin + window_.x_begin, s.x_end + window_.x_begin};
  }
  return spans_;
}

/// The parts in the window; rows of the spans in any order.
std::span<const SampleSpan> BlockPainter::clipped(std::span<const SampleSpan> spans) {
  clipped_.clear();
  for (const SampleSpan& s : spans) {
    const int begin = std::max(s.x_begin, window_.x_begin);
    const int end = std::min(s.x_end, window_.x_end);
    if (begin < end && s.y >= window_.y_begin && s.y < window_.y_end) {
      clipped_.push_back({s.y, begin, end});
    }
  }
  return clipped_;
}

void BlockPainter::flush(PatchShader& shader) {
  Pending& pending = *points_;
  if (pending.colors.count == 0) return;
  shader.shade(pending.colors);
  if (as_words_) {
    scatter_words(pending.colors, pending.runs, pending.run_count, words_.first);
  } else {
    scatter_runs(pending.colors, pending.runs, pending.run_count, channels(),
                 {layer_.channel[0], layer_.channel[1], layer_.channel[2], layer_.channel[3]});
  }
  pending.colors.count = pending.run_count = 0;
}

void BlockPainter::paint_interior(const LayerScene& scene, int patch) {
  const SampleWindow bounds = scene.scan().bounds(patch), part = intersection(bounds, window_);
  if (part.empty()) return;
  const auto spans = all_spans(scene, patch);
  PatchShader shader(scene, patch);
  if (!scene.plans().has(patch)) planner_.plan(shader, bounds, spans, false, plan_);
  const BlockPlan& plan = scene.plans().has(patch) ? scene.plans().of(patch) : plan_;
  if (as_words_) {
    paint_blocks(plan, window_, words_);
  } else {
    paint_blocks(plan, scene.patches().opaque, window_, layer_);
  }
  const auto points = plan.blocks.empty() ? spans : std::span(plan.points);
  paint_points(shader, part == bounds ? points : clipped(points));
}

void BlockPainter::paint_points(PatchShader& shader, std::span<const SampleSpan> spans) {
  while (!spans.empty()) {
    const int taken = append_spans(spans, shader.origin(), {window_.x_begin, window_.y_begin},
                                   layer_.stride, points_->colors, points_->runs);
    points_->run_count += taken;
    spans = spans.subspan(taken);
    flush(shader);
  }
}

void BlockPainter::paint_outline(PatchShader& shader) {
  ColorBatch& batch = points_->colors;
  const int left = window_.x_begin - shader.origin()[0], top = window_.y_begin - shader.origin()[1];
  for (std::size_t begin = 0; begin < seen_.size(); begin += ColorBatch::kCapacity) {
    const auto part = std::span(seen_).subspan(
        begin, std::min<std::size_t>(ColorBatch::kCapacity, seen_.size() - begin));
    batch.count = static_cast<int>(part.size());
    for (int i = 0; i < batch.count; ++i) {
      batch.x[i] = static_cast<float>(left + part[i].column) + part[i].x;
      batch.y[i] = static_cast<float>(top + part[i].row) + part[i].y;
    }
    shader.shade(batch);
    for (int i = 0; i < batch.count; ++i) {
      const std::ptrdiff_t at = part[i].row * layer_.stride + part[i].column;
      for (int k = 0; k < channels(); ++k) {
        layer_.channel[k][at] += batch.color[k][i] * part[i].weight;
      }
    }
  }
}

}  // namespace quadrille
