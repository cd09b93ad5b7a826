#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "quadrille/raster.h"

namespace quadrille {

/// A picture's red, green and blue, premultiplied, and alpha (0 in a picture without).
class PremultipliedColours {
 public:
  using Colour = Eigen::Vector4f;

  explicit PremultipliedColours(const Raster& picture) : picture_(picture) {}

  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  Colour pixel(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * picture_.width + x;
    const float* p = picture_.data.data() + i * picture_.channels;
    if (!picture_.has_alpha()) return {p[0], p[1], p[2], 0};
    return {p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]};
  }
  /// Bilinear between pixel centres, constant outside them.
  Colour at(const Eigen::Vector2d& p) const {
    const double x = std::clamp(p.x() - 0.5, 0.0, picture_.width - 1.0);
    const double y = std::clamp(p.y() - 0.5, 0.0, picture_.height - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const int i1 = std::min(i + 1, picture_.width - 1), j1 = std::min(j + 1, picture_.height - 1);
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    return (1 - v) * ((1 - u) * pixel(i, j) + u * pixel(i1, j)) +
           v * ((1 - u) * pixel(i, j1) + u * pixel(i1, j1));
  }

 private:
  const Raster& picture_;
};

}  // namespace quadrille
