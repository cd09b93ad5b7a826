#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"

namespace quadrille {

/// The colour of pixel number index = y * width + x, premultiplied.
inline Color premultiplied_pixel(const Raster& picture, std::size_t index) {
  const float* p = picture.data.data() + index * picture.channels;
  if (!picture.has_alpha()) return {p[0], p[1], p[2], 1.0f};
  return {p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]};
}

inline Color premultiplied_pixel(const Raster& picture, int x, int y) {
  return premultiplied_pixel(picture, static_cast<std::size_t>(y) * picture.width + x);
}

/// Bilinear interpolation of the premultiplied pixel centres. The half pixel along the border
/// continues its bilinear neighbour, so that linear pictures are reproduced there too.
inline Eigen::Array4d sample_bilinear(const Raster& picture, const Eigen::Vector2d& point) {
  const auto base = [](double t, int size) {
    return static_cast<int>(std::clamp(std::floor(t), 0.0, std::max(0.0, size - 2.0)));
  };
  const double x = std::clamp(point.x(), 0.0, static_cast<double>(picture.width)) - 0.5;
  const double y = std::clamp(point.y(), 0.0, static_cast<double>(picture.height)) - 0.5;
  const int x0 = base(x, picture.width), y0 = base(y, picture.height);
  const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
  const double fx = x - x0, fy = y - y0;
  const auto at = [&](int i, int j) -> Eigen::Array4d {
    return premultiplied_pixel(picture, i, j).cast<double>();
  };
  const Eigen::Array4d top = at(x0, y0) * (1 - fx) + at(x1, y0) * fx;
  const Eigen::Array4d bottom = at(x0, y1) * (1 - fx) + at(x1, y1) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace quadrille
