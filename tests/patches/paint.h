#pragma once

#include <array>
#include <functional>

#include "quadrille/raster.h"

namespace quadrille::testing {

using Painter = std::function<std::array<double, 4>(double x, double y)>;

/// The means of `fineness` x `fineness` samples of each pixel.
inline Raster paint(int width, int height, int channels, int fineness, const Painter& painter) {
  Raster picture(width, height, channels);
  const int samples = fineness * fineness;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::array<double, 4> sum = {};
      for (int i = 0; i < samples; ++i) {
        const auto c =
            painter(x + (i % fineness + 0.5) / fineness, y + (i / fineness + 0.5) / fineness);
        for (int k = 0; k < 4; ++k) sum[k] += c[k] / samples;
      }
      for (int k = 0; k < channels; ++k) picture.pixel(x, y)[k] = static_cast<float>(sum[k]);
    }
  }
  return picture;
}

}  // namespace quadrille::testing
