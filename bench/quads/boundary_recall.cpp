#include "boundary_recall.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "quadrille/error.h"
#include "quadrille/image_file.h"

namespace quadrille::bench {
namespace {

cv::Mat as_matrix(const BoundaryMask& mask) {
  return {mask.height, mask.width, CV_8U, const_cast<unsigned char*>(mask.marked.data())};
}

cv::Mat disk(int radius) {
  cv::Mat element(2 * radius + 1, 2 * radius + 1, CV_8U);
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      element.at<unsigned char>(y + radius, x + radius) = x * x + y * y <= radius * radius;
    }
  }
  return element;
}

BoundaryMask non_zero(const Raster& drawing) {
  BoundaryMask mask{drawing.width, drawing.height, {}};
  for (int y = 0; y < drawing.height; ++y) {
    for (int x = 0; x < drawing.width; ++x) {
      const float* color = drawing.pixel(x, y);
      mask.marked.push_back(std::any_of(color, color + 3, [](float c) { return c > 0; }));
    }
  }
  return mask;
}

}  // namespace

BoundaryScore boundary_score(const BoundaryMask& boundary,
                             const std::vector<BoundaryMask>& annotations) {
  cv::Mat near;
  cv::dilate(as_matrix(boundary), near, disk(kRecallRadius));
  BoundaryScore score;
  for (const BoundaryMask& annotation : annotations) {
    if (annotation.width != boundary.width || annotation.height != boundary.height) {
      throw Error(ErrorCode::invalid_argument, "an annotation differs from its picture in size");
    }
    const cv::Mat drawn = as_matrix(annotation);
    const int wanted = cv::countNonZero(drawn);
    score.recall += wanted ? static_cast<double>(cv::countNonZero(drawn & near)) / wanted : 1.0;
  }
  if (!annotations.empty()) score.recall /= static_cast<double>(annotations.size());
  score.density = static_cast<double>(cv::countNonZero(as_matrix(boundary))) /
                  static_cast<double>(boundary.marked.size());
  return score;
}

std::vector<BoundaryMask> load_annotations(const std::filesystem::path& folder,
                                           const std::string& name) {
  std::vector<BoundaryMask> annotations;
  for (int i = 0;; ++i) {
    const auto file = folder / (name + "_" + std::to_string(i) + ".png");
    if (!std::filesystem::exists(file)) return annotations;
    annotations.push_back(non_zero(load_image(file)));
  }
}

}  // namespace quadrille::bench
