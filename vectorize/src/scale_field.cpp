#include "quadrille/scale_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "opencv_errors.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

/// Exact Euclidean distance to the nearest feature line; the picture's diagonal when there is none.
FieldGrid<float> feature_distance(const FieldGrid<unsigned char>& edges) {
  FieldGrid<float> distance(edges.width, edges.height);
  cv::Mat free(edges.height, edges.width, CV_8U);
  bool any = false;
  for (int y = 0; y < edges.height; ++y) {
    for (int x = 0; x < edges.width; ++x) {
      free.at<unsigned char>(y, x) = !edges(x, y);
      any = any || edges(x, y);
    }
  }
  if (!any) {
    std::fill(distance.data.begin(), distance.data.end(),
              static_cast<float>(std::hypot(edges.width, edges.height)));
    return distance;
  }
  cv::Mat result(edges.height, edges.width, CV_32F, distance.data.data());
  cv::distanceTransform(free, result, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return distance;
}

/// Lowers values until no two 8-neighbours differ by more than `slope` times their distance.
void limit_gradient(FieldGrid<float>& field, float slope) {
  const int w = field.width, h = field.height;
  const float diagonal = slope * std::sqrt(2.0f);
  const auto lower = [&](int x, int y, int nx, int ny, float rise) {
    if (nx < 0 || ny < 0 || nx >= w || ny >= h) return;
    field(x, y) = std::min(field(x, y), field(nx, ny) + rise);
  };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      lower(x, y, x - 1, y, slope);
      lower(x, y, x, y - 1, slope);
      lower(x, y, x - 1, y - 1, diagonal);
      lower(x, y, x + 1, y - 1, diagonal);
    }
  }
  for (int y = h - 1; y >= 0; --y) {
    for (int x = w - 1; x >= 0; --x) {
      lower(x, y, x + 1, y, slope);
      lower(x, y, x, y + 1, slope);
      lower(x, y, x + 1, y + 1, diagonal);
      lower(x, y, x - 1, y + 1, diagonal);
    }
  }
}

void normalise_count(FieldGrid<float>& length, double count) {
  double cells = 0;
  for (float l : length.data) cells += 1.0 / (static_cast<double>(l) * l);
  const float factor = static_cast<float>(std::sqrt(cells / count));
  for (float& l : length.data) l *= factor;
}

/// Whole numbers of cells across and down whose product is nearest to that of the given ones.
std::array<double, 2> whole_cells(double across, double down) {
  std::array<double, 2> best{1, 1};
  double best_miss = std::numeric_limits<double>::max();
  for (const double x : {std::floor(across), std::ceil(across)}) {
    for (const double y : {std::floor(down), std::ceil(down)}) {
      const double miss = std::abs(x * y - across * down);
      if (x >= 1 && y >= 1 && miss < best_miss) best_miss = miss, best = {x, y};
    }
  }
  return best;
}

}  // namespace

ScaleField scale_field(const FeatureTensor& features, const CrossField& field, double count,
                       const ScaleOptions& options, const RunContext& context) {
  if (!(count > 0) || !(options.min_ratio > 0) || options.min_ratio > 1 || !(options.range > 0)) {
    throw Error(ErrorCode::invalid_argument,
                "the scale field needs a positive count and range, and a ratio in (0, 1]");
  }
  context.progress("scale field", 0);
  const int w = features.weight.width, h = features.weight.height;
  const double target = std::sqrt(static_cast<double>(w) * h / count);
  FieldGrid<float> length = with_opencv_errors([&] { return feature_distance(features.edges); });
  const double a = options.min_ratio;
  for (float& l : length.data) {
    const double reach = l / (options.range * target);
    l = static_cast<float>((a + (1 - a) * (1 - std::exp(-reach * reach))) * target);
  }
  limit_gradient(length, static_cast<float>(options.max_gradient));
  normalise_count(length, count);

  double reciprocals = 0;
  for (float l : length.data) reciprocals += 1 / l;
  const double across = reciprocals / h, down = reciprocals / w;
  const auto [columns, rows] = whole_cells(across, down);
  const double fit_x = across / columns, fit_y = down / rows;

  ScaleField scale{length, length};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double angle = field.angle(x, y);
      const double c2 = std::cos(angle) * std::cos(angle), s2 = 1 - c2;
      scale.along_x(x, y) *= static_cast<float>(fit_x * c2 + fit_y * s2);
      scale.along_y(x, y) *= static_cast<float>(fit_x * s2 + fit_y * c2);
    }
  }
  return scale;
}

}  // namespace quadrille
