#pragma once

#include <vector>

#include "layer_scene.h"
#include "outline_pixels.h"
#include "patch_shader.h"

namespace quadrille {

/// Draws layers into blocks of samples; one for each thread. What a sample gets does not depend on
/// the window that it is drawn with, as long as the window lies within one block.
class BlockPainter {
 public:
  BlockPainter();

  /// Draws all layers over each other; the window must not be empty. The result is valid until the
  /// next call: premultiplied samples, rows from the top, no padding.
  std::span<const Color> paint(const std::vector<LayerScene>& scenes, const SampleWindow& window);

 private:
  SampleWindow window_;
  std::vector<Color> picture_, layer_;
  std::vector<SampleSpan> spans_;
  OutlinePixels outline_;
  std::vector<OutlinePixels::Share> shares_;
  PatchShader::Batch batch_;
  std::array<Color*, PatchShader::kBatch> target_;
  std::array<float, PatchShader::kBatch> weight_;

  int width() const { return window_.x_end - window_.x_begin; }
  void paint_layer(const LayerScene& scene, std::span<const int> patches);
  /// Of the spans found within the window `bounds`.
  void paint_interior(const SampleWindow& bounds, PatchShader& shader);
  /// Of the shares found.
  void paint_outline(PatchShader& shader);
};

}  // namespace quadrille
