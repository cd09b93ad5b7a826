#include "fit/edge_error.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "fit/on_white.h"

namespace quadrille::bench {
namespace {

constexpr double kEdgeShare = 0.05;

/// Gradient magnitudes of the picture's grey values, per pixel.
std::vector<float> gradients(const Raster& rgb) {
  const cv::Mat picture(rgb.height, rgb.width, CV_32FC3, const_cast<float*>(rgb.data.data()));
  cv::Mat gray, dx, dy;
  cv::transform(picture, gray, cv::Matx13f(1 / 3.0f, 1 / 3.0f, 1 / 3.0f));
  cv::Sobel(gray, dx, CV_32F, 1, 0, 3, 1, 0, cv::BORDER_REFLECT);
  cv::Sobel(gray, dy, CV_32F, 0, 1, 3, 1, 0, cv::BORDER_REFLECT);
  cv::Mat size;
  cv::magnitude(dx, dy, size);
  return {size.begin<float>(), size.end<float>()};
}

/// The value that the given share of the numbers reaches.
float reached_by(std::vector<float> numbers, double share) {
  const auto nth = numbers.begin() + static_cast<std::ptrdiff_t>(
                                         (1 - share) * static_cast<double>(numbers.size() - 1));
  std::ranges::nth_element(numbers, nth);
  return *nth;
}

}  // namespace

double edge_error(const Raster& original, const Raster& other) {
  const Raster a = on_white(original), b = on_white(other);
  const std::vector<float> gradient = gradients(a);
  const float bound = reached_by(gradient, kEdgeShare);
  double sum = 0;
  long long count = 0;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    if (gradient[i] < bound || gradient[i] <= 0) continue;
    for (int c = 0; c < 3; ++c) sum += std::abs(a.data[3 * i + c] - b.data[3 * i + c]);
    count += 3;
  }
  return 255 * sum / static_cast<double>(count);
}

}  // namespace quadrille::bench
