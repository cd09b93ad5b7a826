#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "quadrille/raster.h"

namespace quadrille::testing {

/// A picture whose alpha is the share of each pixel, by 8 x 8 samples, where `inside(x, y)`; its
/// colours vary smoothly, and are garbage where it is transparent.
inline Raster masked_picture(int width, int height,
                             const std::function<bool(double, double)>& inside) {
  constexpr int kSamples = 8;
  Raster picture(width, height, 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int count = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        count += inside(x + (k % kSamples + 0.5) / kSamples, y + (k / kSamples + 0.5) / kSamples);
      }
      float* p = picture.pixel(x, y);
      p[0] = 0.2f + 0.6f * x / width;
      p[1] = 0.8f - 0.5f * y / height;
      p[2] = 0.3f;
      p[3] = static_cast<float>(count) / (kSamples * kSamples);
      if (count == 0) p[0] = p[1] = p[2] = static_cast<float>((x * 7 + y * 13) % 5) / 4;
    }
  }
  return picture;
}

inline std::function<bool(double, double)> disc(double cx, double cy, double radius) {
  return [=](double x, double y) { return std::hypot(x - cx, y - cy) < radius; };
}

inline std::function<bool(double, double)> ring(double cx, double cy, double inner, double outer) {
  return [=](double x, double y) {
    const double r = std::hypot(x - cx, y - cy);
    return r >= inner && r < outer;
  };
}

/// Alpha from noise of many kinds: blobs, hard and soft, stripes, checkerboards, single pixels.
inline Raster random_mask(std::mt19937& random, int width, int height) {
  Raster picture(width, height, 4);
  const int kind = random() % 7;
  const auto real = [&] { return (random() % 10001) / 10000.0; };
  const double fx = 0.02 + 0.4 * real(), fy = 0.02 + 0.4 * real(), phase = 6 * real();
  const double level = -0.8 + 1.6 * real(), softness = 0.5 + 20 * real();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave =
          std::sin(fx * x + phase) * std::cos(fy * y) + std::sin(0.7 * fx * y - fy * x) - level;
      double alpha = 0;
      switch (kind) {
        case 0:
          alpha = wave > 0;
          break;
        case 1:
          alpha = 0.5 + softness * wave;
          break;
        case 2:
          alpha = (random() % 256) / 255.0;
          break;
        case 3:
          alpha = random() % 2;
          break;
        case 4:
          alpha = (x / 2 + y / 3) % 2;
          break;
        case 5:
          alpha = (x + 2 * y) % 7 == 0;
          break;
        default:
          alpha = random() % 40 == 0 ? random() % 2 : wave > 0;
      }
      float* p = picture.pixel(x, y);
      for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(0.5 + 0.4 * std::sin(fx * x + c * y));
      p[3] = static_cast<float>(std::clamp(alpha, 0.0, 1.0));
    }
  }
  picture.pixel(width / 2, height / 2)[3] = 1;
  return picture;
}

}  // namespace quadrille::testing
