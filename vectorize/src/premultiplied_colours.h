#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "quadrille/raster.h"

namespace quadrille {

/// A picture's red, green and blue, premultiplied, and alpha (0 in a picture without); a copy of 16
/// bytes a pixel, which makes looking many of them up cheap.
class PremultipliedColours {
 public:
  using Colour = Eigen::Vector4f;

  explicit PremultipliedColours(const Raster& picture)
      : width_(picture.width), height_(picture.height) {
    const std::size_t count = static_cast<std::size_t>(width_) * height_;
    pixels_.resize(count);
    const float* p = picture.data.data();
    for (std::size_t i = 0; i < count; ++i, p += picture.channels) {
      pixels_[i] = picture.has_alpha() ? Colour(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3])
                                       : Colour(p[0], p[1], p[2], 0);
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  const Colour& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * width_ + x];
  }
  /// Bilinear between pixel centres, constant outside them.
  Colour at(const Eigen::Vector2d& p) const {
    const double x = std::clamp(p.x() - 0.5, 0.0, width_ - 1.0);
    const double y = std::clamp(p.y() - 0.5, 0.0, height_ - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const Colour* const above = &pixel(i, j);
    const Colour* const below = above + (j + 1 < height_ ? width_ : 0);
    const int right = i + 1 < width_ ? 1 : 0;
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    return (1 - v) * ((1 - u) * above[0] + u * above[right]) +
           v * ((1 - u) * below[0] + u * below[right]);
  }

 private:
  int width_, height_;
  std::vector<Colour> pixels_;
};

}  // namespace quadrille
