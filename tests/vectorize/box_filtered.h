#pragma once

#include <Eigen/Core>
#include <functional>

#include "quadrille/raster.h"

namespace quadrille::test {

/// The picture that means over 16 x 16 points of each pixel give. Grey where `share` is constant:
/// from `low` where it is 0 to `high` where it is 1.
inline Raster box_filtered(int width, int height, const Eigen::Vector3d& low,
                           const Eigen::Vector3d& high,
                           const std::function<double(double, double)>& share) {
  constexpr int kSamples = 16;
  Raster picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double mean = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        mean += share(x + (k % kSamples + 0.5) / kSamples, y + (k / kSamples + 0.5) / kSamples);
      }
      mean /= kSamples * kSamples;
      for (int c = 0; c < 3; ++c) {
        picture.pixel(x, y)[c] = static_cast<float>(low[c] + mean * (high[c] - low[c]));
      }
    }
  }
  return picture;
}

inline const Eigen::Vector3d kDark{0.2, 0.3, 0.5}, kBright{0.9, 0.7, 0.3};

/// A bright disc on dark ground.
inline Raster disc_picture(int width, int height, const Eigen::Vector2d& centre, double radius) {
  return box_filtered(width, height, kDark, kBright, [&](double x, double y) {
    return (Eigen::Vector2d(x, y) - centre).norm() < radius ? 1.0 : 0.0;
  });
}

}  // namespace quadrille::test
