#include "error_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "chain_choice.h"
#include "premultiplied_colours.h"

namespace quadrille {
namespace {

// The error of a quad of size h grows as C sqrt(h), and the wished h as C^(-1/2.5); so the density
// 1 / h^2 grows as this power of the error times that of the size.
constexpr double kErrorPower = 0.8, kSizePower = 1.6;
constexpr double kLeastError = 0.15;    // of the mean: flat areas stay covered
constexpr double kMostChange = 6;       // of the density, either way
constexpr double kWindow = 0.35;        // sigma of the error's window, in edges
constexpr double kLeastCounted = 0.02;  // share of pixels that a mean takes for granted

/// 1 at the pixels whose error counts, 0 beside the chains: there it is expected to go away.
cv::Mat counted_pixels(const FieldGrid<float>& error, const ChainNetwork& chains) {
  cv::Mat counted(error.height, error.width, CV_32F, cv::Scalar(1));
  for (const FeatureChain& chain : chains.chains) {
    for (const Eigen::Vector2d& p : chain.points) {
      cv::circle(counted, {static_cast<int>(p.x()), static_cast<int>(p.y())},
                 static_cast<int>(kBesideChain), cv::Scalar(0), cv::FILLED);
    }
  }
  return counted;
}

}  // namespace

FieldGrid<float> squared_error(const Raster& shown, const Raster& fitted) {
  const PremultipliedColours a(shown), b(fitted);
  const bool both_opaque = !shown.has_alpha() && !fitted.has_alpha();
  FieldGrid<float> error(shown.width, shown.height);
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      Eigen::Vector4f d = a.pixel(x, y) - b.pixel(x, y);
      if (!both_opaque && !shown.has_alpha()) d[3] = 1 - b.pixel(x, y)[3];
      if (!both_opaque && !fitted.has_alpha()) d[3] = a.pixel(x, y)[3] - 1;
      error(x, y) = d.squaredNorm();
    }
  }
  return error;
}

FieldGrid<float> error_density(const Quadrangulation& quads, const FieldGrid<float>& error) {
  const int w = quads.scale.along_x.width, h = quads.scale.along_x.height;
  const cv::Mat counted = counted_pixels(error, quads.chains);
  cv::Mat source(error.height, error.width, CV_32F), mean, weight;
  for (int y = 0; y < error.height; ++y) {
    for (int x = 0; x < error.width; ++x) {
      source.at<float>(y, x) = counted.at<float>(y, x) * std::sqrt(error(x, y));
    }
  }
  cv::resize(source, mean, {w, h}, 0, 0, cv::INTER_AREA);
  cv::resize(counted, weight, {w, h}, 0, 0, cv::INTER_AREA);
  FieldGrid<float> size(w, h);
  for (std::size_t i = 0; i < size.data.size(); ++i) {
    size.data[i] = std::sqrt(quads.scale.along_x.data[i] * quads.scale.along_y.data[i]);
  }
  const double mean_size =
      std::accumulate(size.data.begin(), size.data.end(), 0.0) / size.data.size();
  for (cv::Mat* m : {&mean, &weight}) {
    cv::GaussianBlur(*m, *m, {}, std::max(0.5, kWindow * mean_size), 0, cv::BORDER_REPLICATE);
  }
  mean /= weight + kLeastCounted;
  const double mean_error = std::max(cv::mean(mean)[0], 1e-6);
  FieldGrid<float> density(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double lacking =
          std::pow(mean.at<float>(y, x) / mean_error + kLeastError, kErrorPower) *
          std::pow(size(x, y) / mean_size, kSizePower);
      density(x, y) = static_cast<float>(std::clamp(lacking, 1 / kMostChange, kMostChange));
    }
  }
  return density;
}

}  // namespace quadrille
