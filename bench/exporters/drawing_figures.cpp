#include "exporters/drawing_figures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "fit/edge_error.h"
#include "quadrille/metrics.h"

namespace quadrille::bench {
namespace {

constexpr double kHighestPsnr = 99;

cv::Mat alpha_of(const Raster& picture) {
  cv::Mat alpha(picture.height, picture.width, CV_32F, cv::Scalar(1));
  if (!picture.has_alpha()) return alpha;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) alpha.at<float>(y, x) = picture.pixel(x, y)[3];
  }
  return alpha;
}

/// PSNR that the same squared error has over `share` of the pixels.
double psnr_over(double psnr, double share) {
  return psnr >= kHighestPsnr ? psnr : std::min(kHighestPsnr, psnr + 10 * std::log10(share));
}

}  // namespace

nlohmann::ordered_json drawing_figures(const Raster& reference, const Raster& drawing) {
  constexpr float kOpaque = 1 - 0.5f / 255;
  const cv::Mat expected = alpha_of(reference);
  const cv::Mat leak = 255 * (1 - alpha_of(drawing));
  const cv::Mat opaque = expected >= kOpaque, inside = expected > 0.5f / 255;
  cv::Mat interior;
  cv::erode(opaque, interior, cv::Mat::ones(5, 5, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar(0));
  const double share = double(cv::countNonZero(inside)) / double(inside.total());

  nlohmann::ordered_json figures = {{"psnr", psnr_over(compare(reference, drawing).psnr, share)},
                                    {"edge_mae", edge_error(reference, drawing)}};
  if (cv::countNonZero(interior) == 0) return figures;
  double leak_max = 0, border_max = 0;
  cv::minMaxLoc(leak, nullptr, &leak_max, nullptr, nullptr, interior);
  cv::minMaxLoc(leak, nullptr, &border_max, nullptr, nullptr, opaque);
  figures["leak_mean"] = cv::mean(leak, interior)[0];
  figures["leak_max"] = leak_max;
  figures["border_max"] = border_max;
  return figures;
}

}  // namespace quadrille::bench
