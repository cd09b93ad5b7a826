#include "block_painter.h"

#include <algorithm>

#include "patch_shader.h"

namespace quadrille {
namespace {

constexpr std::size_t kPlane = std::size_t{1} * kBlockSide * kBlockSide;

void set_planes(std::vector<float>& memory, SamplePlanes& planes) {
  memory.assign(4 * kPlane + ColorBatch::kPadding, 0.0f);
  for (int k = 0; k < 4; ++k) planes.channel[k] = memory.data() + k * kPlane;
  planes.stride = kBlockSide;
}

}  // namespace

BlockPainter::BlockPainter()
    : points_(std::make_unique<Pending>()), parameters_(std::make_unique<Pending>()) {
  set_planes(memory_[0], picture_);
  set_planes(memory_[1], layer_);
}

void BlockPainter::clear(SamplePlanes& planes) {
  planes.has_alpha = with_alpha_;
  const int height = window_.y_end - window_.y_begin;
  for (int k = 0; k < channels(); ++k) {
    for (int y = 0; y < height; ++y) {
      std::fill_n(planes.channel[k] + y * planes.stride, width(), 0.0f);
    }
  }
}

const SamplePlanes& BlockPainter::paint(const std::vector<LayerScene>& scenes,
                                        const SampleWindow& window, bool with_alpha) {
  window_ = window;
  with_alpha_ = with_alpha;
  bool first = true;
  for (const LayerScene& scene : scenes) {
    const auto patches = scene.patches_at(window);
    if (patches.empty()) continue;
    clear(layer_);
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

/// Puts the layer over the picture.
void BlockPainter::merge_layer() {
  for (int y = 0; y < window_.y_end - window_.y_begin; ++y) {
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
  outline_.find(scene.scan(), patches, window_);
  outlines_.start(scene.scan(), window_);
  if (with_alpha_ && scene.patches().opaque) {
    for (const auto& pending : {points_.get(), parameters_.get()}) {
      std::ranges::fill(pending->colors.color[3], 1.0f);
    }
  }
  // Backwards, so that of patches that overlap the lowest one is seen.
  for (auto q = patches.rbegin(); q != patches.rend(); ++q) {
    outlines_.spans(*q, spans_);
    if (!spans_.empty()) paint_interior(scene, *q);
  }
  for (const OutlinePixels::Pixel& p : outline_.pixels()) {
    const std::ptrdiff_t at = (p.y - window_.y_begin) * layer_.stride + (p.x - window_.x_begin);
    for (int k = 0; k < channels(); ++k) layer_.channel[k][at] = 0;
  }
  if (outline_.pixels().empty()) return;
  for (const int q : patches) {
    outline_.take(scene.scan(), q, shares_);
    if (shares_.empty()) continue;
    PatchShader shader(scene, q);
    paint_outline(shader);
  }
  points_->colors.count = 0;
}

void BlockPainter::flush(Pending& pending, PatchShader& shader) {
  if (pending.colors.count == 0) return;
  if (&pending == points_.get()) {
    shader.shade(pending.colors);
  } else {
    shader.shade_at_parameters(pending.colors);
  }
  scatter_runs(pending.colors, pending.runs, pending.run_count, channels(),
               {layer_.channel[0], layer_.channel[1], layer_.channel[2], layer_.channel[3]});
  pending.colors.count = pending.run_count = 0;
}

void BlockPainter::paint_interior(const LayerScene& scene, int patch) {
  PatchShader shader(scene, patch);
  // Blocks pay where a patch covers a good part of several, wherever the window is cut.
  constexpr int kLeast = 3 * kParameterBlock / 2;
  const SampleWindow bounds = scene.scan().bounds(patch);
  if (std::min(bounds.x_end - bounds.x_begin, bounds.y_end - bounds.y_begin) < kLeast) {
    for (const SampleSpan& s : spans_) paint_points(shader, s);
  } else {
    paint_blocks(shader, intersection(bounds, window_));
  }
  flush(*points_, shader);
  flush(*parameters_, shader);
}

void BlockPainter::paint_points(PatchShader& shader, const SampleSpan& s) {
  ColorBatch& batch = points_->colors;
  const int left = window_.x_begin - shader.origin()[0], top = window_.y_begin - shader.origin()[1];
  const float y = static_cast<float>(top + s.y) + 0.5f;
  for (int begin = s.x_begin; begin < s.x_end;) {
    if (!points_->has_room(1, 1)) flush(*points_, shader);
    const int count = std::min(s.x_end - begin, ColorBatch::kCapacity - batch.count);
    // In whole groups: what is too much is written over.
    float* const xs = batch.x + batch.count;
    float* const ys = batch.y + batch.count;
    for (int i = 0; i < count; i += 8) {
      for (int k = 0; k < 8; ++k) {
        xs[i + k] = static_cast<float>(left + begin + i + k) + 0.5f;
        ys[i + k] = y;
      }
    }
    points_->runs[points_->run_count++] = {batch.count, count, s.y * layer_.stride + begin};
    batch.count += count;
    begin += count;
  }
}

/// By blocks on the absolute grid, where their polynomials are good enough.
void BlockPainter::paint_blocks(PatchShader& shader, const SampleWindow& part) {
  constexpr int kSide = kParameterBlock;
  const int first_x = part.x_begin / kSide, last_x = (part.x_end - 1) / kSide + 1;
  const int first_y = part.y_begin / kSide, last_y = (part.y_end - 1) / kSide + 1;
  ParameterBlock blocks[kBlocks * kBlocks];
  bool fit[kBlocks * kBlocks];
  int count = 0;
  for (int y = first_y; y < last_y; ++y) {
    for (int x = first_x; x < last_x; ++x) {
      blocks[count++] = {static_cast<float>(x * kSide - shader.origin()[0]),
                         static_cast<float>(y * kSide - shader.origin()[1])};
    }
  }
  shader.judge(blocks, count, fit);
  auto span = spans_.begin();
  for (int y = first_y; y < last_y; ++y) {
    const int band_end = (y + 1) * kSide - window_.y_begin;
    const auto begin = span;
    while (span != spans_.end() && span->y < band_end) ++span;
    for (int x = first_x; x < last_x; ++x) {
      paint_block(shader, x * kSide, y * kSide, {begin, span},
                  fit[(y - first_y) * (last_x - first_x) + (x - first_x)]);
    }
  }
}

/// The parts of the spans in the block whose first sample is (x, y).
void BlockPainter::paint_block(PatchShader& shader, int x, int y, std::span<const SampleSpan> spans,
                               bool fit) {
  const int left = x - window_.x_begin, top = y - window_.y_begin;
  rows_.clear();
  for (const SampleSpan& s : spans) {
    const int begin = std::max(s.x_begin, left);
    const int end = std::min(s.x_end, left + kParameterBlock);
    if (begin < end) rows_.push_back({s.y - top, begin - left, end - begin});
  }
  if (rows_.empty()) return;
  Pending& pending = *parameters_;
  const int row_count = static_cast<int>(rows_.size());
  if (fit && !pending.has_room(kParameterBlock * kParameterBlock, row_count)) {
    flush(pending, shader);
  }
  int at = pending.colors.count;
  const ParameterBlock block = {static_cast<float>(x - shader.origin()[0]),
                                static_cast<float>(y - shader.origin()[1])};
  if (fit && shader.add(block, rows_, pending.colors)) {
    for (const BlockRow& row : rows_) {
      pending.runs[pending.run_count++] = {at, row.count,
                                           (top + row.y) * layer_.stride + left + row.x};
      at += row.count;
    }
    return;
  }
  for (const BlockRow& row : rows_) {
    paint_points(shader, {top + row.y, left + row.x, left + row.x + row.count});
  }
}

void BlockPainter::paint_outline(PatchShader& shader) {
  ColorBatch& batch = points_->colors;
  for (std::size_t begin = 0; begin < shares_.size(); begin += ColorBatch::kCapacity) {
    batch.count =
        static_cast<int>(std::min<std::size_t>(ColorBatch::kCapacity, shares_.size() - begin));
    for (int i = 0; i < batch.count; ++i) {
      const OutlinePixels::Share& share = shares_[begin + i];
      const OutlinePixels::Pixel& p = outline_.pixels()[share.pixel];
      batch.x[i] = static_cast<float>(p.x - shader.origin()[0]) + share.x;
      batch.y[i] = static_cast<float>(p.y - shader.origin()[1]) + share.y;
    }
    shader.shade(batch);
    for (int i = 0; i < batch.count; ++i) {
      const OutlinePixels::Share& share = shares_[begin + i];
      const OutlinePixels::Pixel& p = outline_.pixels()[share.pixel];
      const std::ptrdiff_t at = (p.y - window_.y_begin) * layer_.stride + (p.x - window_.x_begin);
      for (int k = 0; k < channels(); ++k) {
        layer_.channel[k][at] += batch.color[k][i] * share.weight;
      }
    }
  }
}

}  // namespace quadrille
