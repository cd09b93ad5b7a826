#include "density_map.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "opencv_errors.h"

namespace quadrille {
namespace {

constexpr float kLeastDensity = 1.0f / 64;  // of black; cells eight times as long as under white

float brightness(const float* pixel, bool has_alpha) {
  const float mean = (pixel[0] + pixel[1] + pixel[2]) / 3;
  return has_alpha ? pixel[3] * mean : mean;
}

}  // namespace

FieldGrid<float> density_map(const Raster& map, int width, int height) {
  if (map.data.empty()) return {};
  check_raster(map);
  cv::Mat source(map.height, map.width, CV_32F);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      source.at<float>(y, x) =
          std::max(kLeastDensity, brightness(map.pixel(x, y), map.has_alpha()));
    }
  }
  const auto [least, most] = std::minmax_element(source.begin<float>(), source.end<float>());
  if (*least == *most) return {};
  FieldGrid<float> density(width, height);
  const bool smaller = width < map.width || height < map.height;
  with_opencv_errors([&] {
    cv::Mat target(height, width, CV_32F, density.data.data());
    cv::resize(source, target, target.size(), 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  });
  return density;
}

}  // namespace quadrille
