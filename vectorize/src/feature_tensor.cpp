// Di Zenzo, A note on the gradient of a multi-image, 1986; Canny, 1986.
#include "quadrille/feature_tensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "opencv_errors.h"
#include "parallel.h"

namespace quadrille {
namespace {

// Gradients below this are noise of 8-bit pictures, whatever the rest of the picture holds.
constexpr float kNoiseFloor = 3.0f / 255;
// Canny's thresholds follow the picture's own gradients between these bounds.
constexpr float kMinCannyHigh = 4.0f / 255, kMaxCannyHigh = 24.0f / 255;
constexpr float kCannyLowRatio = 0.4f;
// The robust scale is this percentile on feature lines: features above it have full weight.
constexpr double kStrongShare = 0.8;
// Fixed-point unit of the gradients given to Canny.
constexpr float kCannyUnit = 16384;

cv::Mat wrap(FieldGrid<float>& grid) {
  return cv::Mat(grid.height, grid.width, CV_32F, grid.data.data());
}

/// Sums the channels' gradients as 2-fold tensors |grad|^2 e^{2 i phi} and |grad|^2.
struct ColourTensor {
  FieldGrid<std::complex<float>> twofold;
  FieldGrid<float> energy;
};

ColourTensor colour_tensor(const Raster& picture, double sigma, const RunContext& context) {
  ColourTensor tensor{FieldGrid<std::complex<float>>(picture.width, picture.height),
                      FieldGrid<float>(picture.width, picture.height)};
  const cv::Mat all(picture.height, picture.width, CV_32FC(picture.channels),
                    const_cast<float*>(picture.data.data()));
  for (int c = 0; c < picture.channels; ++c) {
    cv::Mat channel, dx, dy;
    cv::extractChannel(all, channel, c);
    cv::GaussianBlur(channel, channel, {}, sigma, sigma, cv::BORDER_REPLICATE);
    cv::Sobel(channel, dx, CV_32F, 1, 0, 3, 1.0 / 8, 0, cv::BORDER_REPLICATE);
    cv::Sobel(channel, dy, CV_32F, 0, 1, 3, 1.0 / 8, 0, cv::BORDER_REPLICATE);
    parallel_rows(context, picture.height, picture.width, [&](int y) {
      const float *gx = dx.ptr<float>(y), *gy = dy.ptr<float>(y);
      for (int x = 0; x < picture.width; ++x) {
        tensor.twofold(x, y) +=
            std::complex<float>(gx[x] * gx[x] - gy[x] * gy[x], 2 * gx[x] * gy[x]);
        tensor.energy(x, y) += gx[x] * gx[x] + gy[x] * gy[x];
      }
    });
  }
  return tensor;
}

float percentile(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

FieldGrid<unsigned char> canny_edges(const FieldGrid<Eigen::Vector2f>& gradient) {
  const int w = gradient.width, h = gradient.height;
  std::vector<float> lengths(gradient.data.size());
  cv::Mat dx(h, w, CV_16S), dy(h, w, CV_16S);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const Eigen::Vector2f g = gradient(x, y);
      lengths[static_cast<std::size_t>(y) * w + x] = g.norm();
      dx.at<short>(y, x) = cv::saturate_cast<short>(g.x() * kCannyUnit);
      dy.at<short>(y, x) = cv::saturate_cast<short>(g.y() * kCannyUnit);
    }
  }
  const float high = std::clamp(percentile(std::move(lengths), 0.9), kMinCannyHigh, kMaxCannyHigh);
  FieldGrid<unsigned char> edges(w, h);
  cv::Mat result(h, w, CV_8U, edges.data.data());
  cv::Canny(dx, dy, result, kCannyLowRatio * high * kCannyUnit, high * kCannyUnit, true);
  for (auto& e : edges.data) e = e != 0;
  return edges;
}

/// Smoothed four-fold tensor to unit direction and weight. The weight is the tensor's length over a
/// robust scale, times the coherence: the share that is left of the lengths that went into the
/// Gaussian. It is low where directions contradict each other, in texture and at sharp corners.
void set_direction(const ColourTensor& tensor, double sigma, FeatureTensor& features) {
  const int w = tensor.energy.width, h = tensor.energy.height;
  FieldGrid<float> re(w, h), im(w, h), total(w, h);
  for (std::size_t i = 0; i < re.data.size(); ++i) {
    const std::complex<float> t = tensor.twofold.data[i];
    const float length = std::abs(t);
    if (length <= kNoiseFloor * kNoiseFloor) continue;
    const std::complex<float> fourfold = t * t / length;
    re.data[i] = fourfold.real();
    im.data[i] = fourfold.imag();
    total.data[i] = length;
  }
  for (FieldGrid<float>* part : {&re, &im, &total}) {
    cv::Mat mat = wrap(*part);
    cv::GaussianBlur(mat, mat, {}, sigma, sigma, cv::BORDER_REPLICATE);
  }

  std::vector<float> on_edges;
  for (std::size_t i = 0; i < re.data.size(); ++i) {
    if (features.edges.data[i]) on_edges.push_back(std::hypot(re.data[i], im.data[i]));
  }
  const float robust_scale =
      std::max(percentile(std::move(on_edges), kStrongShare), kNoiseFloor * kNoiseFloor);
  for (std::size_t i = 0; i < re.data.size(); ++i) {
    const float length = std::hypot(re.data[i], im.data[i]);
    if (length <= 1e-12f) continue;
    const float coherence = std::min(1.0f, length / total.data[i]);
    features.direction.data[i] = {re.data[i] / length, im.data[i] / length};
    features.weight.data[i] = coherence * std::min(1.0f, length / robust_scale);
  }
}

FeatureTensor compute(const Raster& picture, const FeatureOptions& options,
                      const RunContext& context) {
  const int w = picture.width, h = picture.height;
  const ColourTensor tensor = colour_tensor(picture, options.gradient_sigma, context);
  FeatureTensor features{FieldGrid<std::complex<float>>(w, h), FieldGrid<float>(w, h),
                         FieldGrid<Eigen::Vector2f>(w, h, Eigen::Vector2f::Zero()),
                         FieldGrid<unsigned char>(w, h)};
  parallel_rows(context, h, w, [&](int y) {
    for (int x = 0; x < w; ++x) {
      // The larger eigenvalue of the structure tensor and its eigenvector's angle.
      const std::complex<float> t = tensor.twofold(x, y);
      const float change = std::sqrt(0.5f * (tensor.energy(x, y) + std::abs(t)));
      const float angle = 0.5f * std::arg(t);
      features.gradient(x, y) = change * Eigen::Vector2f(std::cos(angle), std::sin(angle));
    }
  });
  features.edges = canny_edges(features.gradient);
  set_direction(tensor, options.tensor_sigma, features);
  return features;
}

}  // namespace

FeatureTensor feature_tensor(const Raster& picture, const FeatureOptions& options,
                             const RunContext& context) {
  return with_opencv_errors([&] { return compute(picture, options, context); });
}

}  // namespace quadrille
