#include "block_painter.h"

#include <algorithm>

namespace quadrille {
namespace {

Color color_of(const PatchShader::Batch& batch, int i) {
  return {batch.color[0][i], batch.color[1][i], batch.color[2][i], batch.color[3][i]};
}

}  // namespace

BlockPainter::BlockPainter() : picture_(kBlockSide * kBlockSide), layer_(kBlockSide * kBlockSide) {}

std::span<const Color> BlockPainter::paint(const std::vector<LayerScene>& scenes,
                                           const SampleWindow& window) {
  window_ = window;
  const std::size_t count = std::size_t{1} * width() * (window.y_end - window.y_begin);
  std::fill_n(picture_.begin(), count, Color::Zero());
  bool first = true;
  for (const LayerScene& scene : scenes) {
    const auto patches = scene.patches_at(window);
    if (patches.empty()) continue;
    std::fill_n(layer_.begin(), count, Color::Zero());
    paint_layer(scene, patches);
    if (first) {
      picture_.swap(layer_);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        picture_[i] = layer_[i] + picture_[i] * (1 - layer_[i][3]);
      }
    }
    first = false;
  }
  return {picture_.data(), count};
}

void BlockPainter::paint_layer(const LayerScene& scene, std::span<const int> patches) {
  outline_.find(scene.scan(), patches, window_);
  // Backwards, so that of patches that overlap the lowest one is seen.
  for (auto q = patches.rbegin(); q != patches.rend(); ++q) {
    const SampleWindow bounds = intersection(scene.scan().bounds(*q), window_);
    scene.scan().spans(*q, bounds, 0, spans_);
    if (spans_.empty()) continue;
    PatchShader shader(scene.patches(), *q, scene.to_samples(), scene.from_samples());
    paint_interior(bounds, shader);
  }
  for (const OutlinePixels::Pixel& p : outline_.pixels()) {
    layer_[(p.y - window_.y_begin) * width() + (p.x - window_.x_begin)].setZero();
  }
  for (const int q : patches) {
    outline_.take(scene.scan(), q, shares_);
    if (shares_.empty()) continue;
    PatchShader shader(scene.patches(), q, scene.to_samples(), scene.from_samples());
    paint_outline(shader);
  }
}

void BlockPainter::paint_interior(const SampleWindow& bounds, PatchShader& shader) {
  const auto flush = [&] {
    shader.shade(batch_);
    for (int i = 0; i < batch_.count; ++i) *target_[i] = color_of(batch_, i);
    batch_.count = 0;
  };
  for (const SampleSpan& s : spans_) {
    const float y = static_cast<float>(bounds.y_begin + s.y - shader.origin()[1]) + 0.5f;
    Color* const row = layer_.data() + (bounds.y_begin + s.y - window_.y_begin) * width() +
                       (bounds.x_begin - window_.x_begin);
    for (int x = s.x_begin; x < s.x_end; ++x) {
      batch_.x[batch_.count] = static_cast<float>(bounds.x_begin + x - shader.origin()[0]) + 0.5f;
      batch_.y[batch_.count] = y;
      target_[batch_.count] = row + x;
      if (++batch_.count == PatchShader::kBatch) flush();
    }
  }
  flush();
}

void BlockPainter::paint_outline(PatchShader& shader) {
  const auto flush = [&] {
    shader.shade(batch_);
    for (int i = 0; i < batch_.count; ++i) *target_[i] += color_of(batch_, i) * weight_[i];
    batch_.count = 0;
  };
  for (const OutlinePixels::Share& share : shares_) {
    const OutlinePixels::Pixel& p = outline_.pixels()[share.pixel];
    batch_.x[batch_.count] = static_cast<float>(p.x - shader.origin()[0]) + share.x;
    batch_.y[batch_.count] = static_cast<float>(p.y - shader.origin()[1]) + share.y;
    target_[batch_.count] = &layer_[(p.y - window_.y_begin) * width() + (p.x - window_.x_begin)];
    weight_[batch_.count] = share.weight;
    if (++batch_.count == PatchShader::kBatch) flush();
  }
  flush();
}

}  // namespace quadrille
