#include "opaque_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "opencv_errors.h"
#include "quadrille/alpha_outline.h"

namespace quadrille {
namespace {

constexpr int kRim = 2;  // pixels that anti-aliasing of the outline reaches into either side
// More alpha than this is opaque up to the rounding of an 8-bit file.
constexpr float kFullAlpha = 1 - 1.5f / 255;

/// Per pixel the index of the nearest one inside.
std::vector<std::size_t> nearest_inside(const Raster& picture) {
  cv::Mat outside(picture.height, picture.width, CV_8U);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      outside.at<unsigned char>(y, x) = picture.pixel(x, y)[3] < kOpaqueAlpha;
    }
  }
  cv::Mat distance, labels;
  cv::distanceTransform(outside, distance, labels, cv::DIST_L2, cv::DIST_MASK_5,
                        cv::DIST_LABEL_PIXEL);
  // Each inside pixel has a label of its own.
  std::vector<std::size_t> pixel_of_label, nearest;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (outside.at<unsigned char>(y, x)) continue;
      const std::size_t label = labels.at<int>(y, x);
      if (pixel_of_label.size() <= label) pixel_of_label.resize(label + 1);
      pixel_of_label[label] = static_cast<std::size_t>(y) * picture.width + x;
    }
  }
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      nearest.push_back(pixel_of_label[labels.at<int>(y, x)]);
    }
  }
  return nearest;
}

/// Alpha with the rim's replaced by the largest nearby.
cv::Mat alpha_without_rim(const Raster& picture) {
  cv::Mat alpha(picture.height, picture.width, CV_32F);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) alpha.at<float>(y, x) = picture.pixel(x, y)[3];
  }
  const cv::Mat disc =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * kRim + 1, 2 * kRim + 1));
  cv::Mat largest, smallest;
  cv::dilate(alpha, largest, disc);
  cv::erode(alpha, smallest, disc);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (smallest.at<float>(y, x) < kOpaqueAlpha) alpha.at<float>(y, x) = largest.at<float>(y, x);
    }
  }
  return alpha;
}

Raster compute(const Raster& picture) {
  const std::vector<std::size_t> nearest = nearest_inside(picture);
  const cv::Mat alpha = alpha_without_rim(picture);
  bool translucent = false;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      translucent = translucent ||
                    (picture.pixel(x, y)[3] >= kOpaqueAlpha && alpha.at<float>(y, x) < kFullAlpha);
    }
  }
  Raster result(picture.width, picture.height, translucent ? 4 : 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t source = nearest[static_cast<std::size_t>(y) * picture.width + x];
      std::copy_n(picture.data.data() + 4 * source, 3, result.pixel(x, y));
      if (!translucent) continue;
      result.pixel(x, y)[3] = alpha.at<float>(static_cast<int>(source / picture.width),
                                              static_cast<int>(source % picture.width));
    }
  }
  return result;
}

}  // namespace

Raster opaque_picture(const Raster& picture) {
  return with_opencv_errors([&] { return compute(picture); });
}

}  // namespace quadrille
