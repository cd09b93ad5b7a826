#include "slic.h"

#ifdef QUADRILLE_SLIC
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/slic.hpp>
#endif

namespace quadrille::bench {

#ifdef QUADRILLE_SLIC

namespace {

constexpr int kRounds = 10;
constexpr int kSmallestFragment = 25;  // per cent of a cell's mean area

cv::Mat lab_of(const Raster& picture) {
  cv::Mat rgb(picture.height, picture.width, CV_8UC3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float* color = picture.pixel(x, y);
      auto& pixel = rgb.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<unsigned char>(255 * color[c]);
    }
  }
  cv::Mat lab;
  cv::GaussianBlur(rgb, rgb, {3, 3}, 0);
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);
  return lab;
}

}  // namespace

std::optional<SlicResult> slic(const Raster& picture, const SlicOptions& options) {
  const auto segmenter = cv::ximgproc::createSuperpixelSLIC(lab_of(picture), cv::ximgproc::SLIC,
                                                            options.size, options.ruler);
  segmenter->iterate(kRounds);
  segmenter->enforceLabelConnectivity(kSmallestFragment);
  cv::Mat cell;
  segmenter->getLabels(cell);
  SlicResult result{{picture.width, picture.height}, segmenter->getNumberOfSuperpixels()};
  std::copy(cell.begin<int>(), cell.end<int>(), result.labels.label.begin());
  return result;
}

#else

std::optional<SlicResult> slic(const Raster&, const SlicOptions&) { return {}; }

#endif

}  // namespace quadrille::bench
