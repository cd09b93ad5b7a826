#pragma once

#include <algorithm>
#include <cmath>

#include "quadrille/raster.h"

namespace quadrille::bench {

/// The picture without alpha as an 8-bit file of it looks over white; samples in [0, 1].
inline Raster on_white(const Raster& picture) {
  const auto rounded = [](float value) {
    return std::floor(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f) / 255;
  };
  Raster result(picture.width, picture.height, 3);
  for (std::size_t i = 0, p = 0; i < result.data.size(); i += 3, p += picture.channels) {
    const float alpha = picture.has_alpha() ? rounded(picture.data[p + 3]) : 1;
    for (int c = 0; c < 3; ++c) {
      result.data[i + c] = rounded(picture.data[p + c]) * alpha + (1 - alpha);
    }
  }
  return result;
}

}  // namespace quadrille::bench
