#pragma once

#include <algorithm>
#include <array>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Puts premultiplied samples over a background and writes them as straight output pixels.
class PixelWriter {
 public:
  /// The background is straight and clamped to [0, 1]; 3 channels leave alpha out. Throws
  /// Error{invalid_argument} for a background that is not finite.
  PixelWriter(const std::array<float, 4>& background, int channels);

  void write(const Color& premultiplied, float* pixel) const {
    const Color c = premultiplied + behind_ * (1 - premultiplied[3]);
    const float alpha = std::clamp(c[3], 0.0f, 1.0f);
    const float divisor = alpha > 0 ? alpha : 1.0f;
    const Color straight = (c / divisor).max(0.0f).min(1.0f);
    for (int k = 0; k < 3; ++k) pixel[k] = straight[k];
    if (channels_ == 4) pixel[3] = alpha;
  }

 private:
  int channels_;
  Color behind_;  // premultiplied
};

}  // namespace quadrille
