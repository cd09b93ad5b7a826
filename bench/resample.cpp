#include "resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace quadrille::bench {
namespace {

Raster premultiplied(Raster picture) {
  if (!picture.has_alpha()) return picture;
  for (std::size_t i = 0; i < picture.data.size(); i += 4) {
    for (int c = 0; c < 3; ++c) picture.data[i + c] *= picture.data[i + 3];
  }
  return picture;
}

/// Undoes premultiplied(), for samples that filters may have driven out of range.
void make_straight(Raster& picture) {
  for (std::size_t i = 0; i < picture.data.size(); i += picture.channels) {
    float* const pixel = &picture.data[i];
    const float alpha = picture.has_alpha() ? std::clamp(pixel[3], 0.0f, 1.0f) : 1;
    for (int c = 0; c < 3; ++c) {
      pixel[c] = alpha > 0 ? std::clamp(pixel[c] / alpha, 0.0f, 1.0f) : 0;
    }
    if (picture.has_alpha()) pixel[3] = alpha;
  }
}

Raster resized(const Raster& picture, int width, int height, int method) {
  const Raster source = premultiplied(picture);
  Raster result(width, height, picture.channels);
  const int type = CV_32FC(picture.channels);
  const cv::Mat from(source.height, source.width, type, const_cast<float*>(source.data.data()));
  cv::Mat to(height, width, type, result.data.data());
  cv::resize(from, to, to.size(), 0, 0, method);
  make_straight(result);
  return result;
}

}  // namespace

Raster enlarged(const Raster& picture, double factor, Interpolation interpolation) {
  constexpr std::array kMethods = {cv::INTER_NEAREST, cv::INTER_CUBIC, cv::INTER_LANCZOS4};
  return resized(picture, static_cast<int>(std::lround(factor * picture.width)),
                 static_cast<int>(std::lround(factor * picture.height)),
                 kMethods[static_cast<int>(interpolation)]);
}

Raster reduced(const Raster& picture, int factor) {
  Raster result = resized(picture, picture.width / factor, picture.height / factor, cv::INTER_AREA);
  for (float& sample : result.data) sample = std::round(sample * 255) / 255;
  return result;
}

}  // namespace quadrille::bench
