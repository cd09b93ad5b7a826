#include "reduced_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "opencv_errors.h"

namespace quadrille {

Raster premultiplied(const Raster& picture) {
  Raster result = picture;
  for (std::size_t i = 0; i < result.data.size(); i += 4) {
    for (int c = 0; c < 3; ++c) result.data[i + c] *= result.data[i + 3];
  }
  return result;
}

Raster resized(const Raster& picture, int w, int h) {
  Raster result(w, h, picture.channels);
  const int type = CV_32FC(picture.channels);
  const cv::Mat source(picture.height, picture.width, type,
                       const_cast<float*>(picture.data.data()));
  cv::Mat target(h, w, type, result.data.data());
  const bool smaller = w < picture.width || h < picture.height;
  with_opencv_errors([&] {
    cv::resize(source, target, target.size(), 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  });
  return result;
}

Raster reduced_picture(const Raster& picture, double factor) {
  const auto side = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(length / factor)));
  };
  const int width = side(picture.width), height = side(picture.height);
  if (!picture.has_alpha()) return resized(picture, width, height);
  Raster result = resized(premultiplied(picture), width, height);
  for (std::size_t i = 0; i < result.data.size(); i += 4) {
    const float alpha = result.data[i + 3];
    for (int c = 0; c < 3; ++c) result.data[i + c] = alpha > 0 ? result.data[i + c] / alpha : 0;
  }
  return result;
}

}  // namespace quadrille
