#pragma once

#include <cstddef>
#include <vector>

namespace quadrille {

/// A picture of samples: float32, interleaved RGB or RGBA, rows from the top, no padding.
/// Values are sRGB-encoded in [0, 1]; alpha is straight (not premultiplied).
/// The centre of pixel (i, j) is (i + 0.5, j + 0.5), y points down, the picture is the rectangle
/// [0, width] x [0, height].
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 3;  ///< 3 (RGB) or 4 (RGBA)
  std::vector<float> data;

  Raster() = default;
  /// All samples zero. Throws Error{invalid_argument} unless width, height >= 1 and channels is 3
  /// or 4.
  Raster(int width, int height, int channels);

  bool has_alpha() const { return channels == 4; }
  float* pixel(int x, int y) { return data.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return data.data() + offset(x, y); }

  bool operator==(const Raster&) const = default;

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

/// Throws Error{invalid_argument} when the fields contradict each other or a sample is not finite.
void check_raster(const Raster& picture);

/// The w x h pixels whose top-left pixel is (x, y). Throws Error{invalid_argument} unless the
/// rectangle lies inside the picture.
Raster crop(const Raster& picture, int x, int y, int w, int h);

}  // namespace quadrille
