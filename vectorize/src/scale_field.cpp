#include "quadrille/scale_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "length_smoothing.h"
#include "metric_field.h"
#include "opencv_errors.h"
#include "option_checks.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr double kWindow = 0.35;        // sigma of the window of the colour change, in edges
constexpr double kCoarsePerEdge = 3.5;  // pixels of the smoothing's grid per edge
constexpr double kIsotropicRadius = 1;  // around singularities, in edges

[[noreturn]] void refuse() {
  throw Error(ErrorCode::invalid_argument,
              "the scale field's options are out of range; see ScaleOptions");
}

void check_size(const FieldGrid<float>& density, const FeatureTensor& features, double edge) {
  const bool fits = density.data.empty() || (density.width == features.weight.width &&
                                             density.height == features.weight.height);
  if (!(edge > 0) || !fits) refuse();
}

/// The structure tensor of the colour change, smoothed over a window.
struct ChangeTensor {
  cv::Mat xx, xy, yy;
  double mean = 0;  // change along an axis, over the picture

  ChangeTensor(const FieldGrid<Eigen::Vector2f>& gradient, double sigma) {
    const int w = gradient.width, h = gradient.height;
    for (cv::Mat* m : {&xx, &xy, &yy}) m->create(h, w, CV_32F);
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const Eigen::Vector2f g = gradient(x, y);
        // The square root between |g| (thin features count) and |g|^2 (strong ones do).
        const float size = g.norm(), share = size > 0 ? 1 / std::sqrt(size) : 0;
        xx.at<float>(y, x) = share * g.x() * g.x();
        xy.at<float>(y, x) = share * g.x() * g.y();
        yy.at<float>(y, x) = share * g.y() * g.y();
      }
    }
    for (cv::Mat* m : {&xx, &xy, &yy}) {
      cv::GaussianBlur(*m, *m, {}, sigma, sigma, cv::BORDER_REPLICATE);
    }
    mean = 0.5 * (cv::mean(xx)[0] + cv::mean(yy)[0]);
  }

  float along(int x, int y, float c, float s) const {
    return c * c * xx.at<float>(y, x) + 2 * c * s * xy.at<float>(y, x) + s * s * yy.at<float>(y, x);
  }
};

FieldGrid<AxisPair> wished_lengths(const FeatureTensor& features, const CrossField& field,
                                   double edge, const ScaleOptions& options) {
  const int w = field.z.width, h = field.z.height;
  const ChangeTensor change(features.gradient, std::max(0.5, kWindow * edge));
  const double shortest = std::log(options.min_ratio), longest = std::log(options.max_ratio);
  const auto length = [&](double here) {
    if (!(change.mean > 0)) return 0.0;
    return std::clamp(-options.grading * std::log(here / change.mean + options.flat_share),
                      shortest, longest);
  };
  FieldGrid<AxisPair> wished(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const auto angle = static_cast<float>(field.angle(x, y));
      const float c = std::cos(angle), s = std::sin(angle);
      const double denser =
          options.density.data.empty() ? 0 : -0.5 * std::log(options.density(x, y));
      wished(x, y) = {static_cast<float>(length(change.along(x, y, c, s)) + denser),
                      static_cast<float>(length(change.along(x, y, -s, c)) + denser)};
    }
  }
  return wished;
}

/// 0 at singularities, where a cell has no two axes to tell apart, to 1 at `radius` pixels.
FieldGrid<float> anisotropy_share(const CrossField& field, double radius) {
  const int w = field.z.width, h = field.z.height;
  FieldGrid<float> share(w, h, 1.0f);
  const std::vector<Singularity> points = singularities(field);
  if (points.empty()) return share;
  cv::Mat free(h, w, CV_8U, cv::Scalar(255)), distance;
  for (const Singularity& s : points) {
    free.at<unsigned char>(static_cast<int>(s.y), static_cast<int>(s.x)) = 0;
  }
  cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_3);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      share(x, y) = std::min(1.0f, distance.at<float>(y, x) / static_cast<float>(radius));
    }
  }
  return share;
}

ScaleField compute(const FeatureTensor& features, const CrossField& field, double edge,
                   const ScaleOptions& options, const RunContext& context) {
  const int w = field.z.width, h = field.z.height;
  const int factor = std::max(1, static_cast<int>(std::lround(edge / kCoarsePerEdge)));
  CoarseMetric metric(field, wished_lengths(features, field, edge, options), factor);
  if (options.reach > 0) smooth_lengths(metric, options.reach * edge / factor, context);

  const float most = 0.5f * static_cast<float>(std::log(options.max_anisotropy));
  const FieldGrid<MetricTensor> tensors = metric.tensors();
  const FieldGrid<float> share = anisotropy_share(field, kIsotropicRadius * edge);
  ScaleField scale{FieldGrid<float>(w, h), FieldGrid<float>(w, h)};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const MetricTensor tensor = interpolated(tensors, factor, x, y);
      const AxisPair full = tensor.along(std::polar(1.0f, static_cast<float>(field.angle(x, y))));
      const float half = std::clamp(0.5f * (full.x - full.y), -most, most) * share(x, y);
      scale.along_x(x, y) = std::exp(tensor.mean + half);
      scale.along_y(x, y) = std::exp(tensor.mean - half);
    }
  }
  return scale;
}

/// Whole numbers of cells across and down whose product is near to that of the given ones.
std::array<double, 2> whole_cells(double across, double down, double stretch_cost) {
  constexpr int kReach = 3;  // how far from the given numbers
  std::array<double, 2> best{1, 1};
  double least = std::numeric_limits<double>::max();
  const auto consider = [&](double x, double y) {
    if (!(x >= 1 && y >= 1)) return;
    const double stretch_x = std::log(x / across), stretch_y = std::log(y / down);
    const double cost =
        std::abs(stretch_x + stretch_y) + stretch_cost * std::abs(stretch_x - stretch_y);
    if (cost < least) least = cost, best = {x, y};
  };
  for (int k = -kReach; k <= kReach; ++k) {
    const double x = std::floor(across) + k, y = std::floor(down) + k;
    consider(x, std::round(across * down / x));
    consider(std::round(across * down / y), y);
  }
  return best;
}

}  // namespace

void check_options(const ScaleOptions& options) {
  const auto from = [](double least, double value) {
    return value >= least && std::isfinite(value);
  };
  const bool map_positive = std::all_of(options.density.data.begin(), options.density.data.end(),
                                        [](float d) { return d > 0 && std::isfinite(d); });
  if (!from(0, options.grading) || !(options.flat_share > 0) ||
      !(options.min_ratio > 0 && options.min_ratio <= 1) || !from(1, options.max_ratio) ||
      !from(1, options.max_anisotropy) || !from(0, options.reach) || !map_positive) {
    refuse();
  }
}

ScaleField relative_scale(const FeatureTensor& features, const CrossField& field, double edge,
                          const ScaleOptions& options, const RunContext& context) {
  check_options(options);
  check_size(options.density, features, edge);
  context.progress("scale field", 0);
  return with_opencv_errors([&] { return compute(features, field, edge, options, context); });
}

ScaleField scaled_to_count(const ScaleField& relative, const CrossField& field, double count,
                           const SideFit& fit) {
  const int w = field.z.width, h = field.z.height;
  double cells = 0, across = 0, down = 0;
  FieldGrid<float> horizontal(w, h);  // cos^2 of the x-axis' angle
  for (std::size_t i = 0; i < field.z.data.size(); ++i) {
    const float c2 = 0.5f + 0.5f * std::cos(0.5f * std::arg(field.z.data[i]));
    const double rx = 1.0 / relative.along_x.data[i], ry = 1.0 / relative.along_y.data[i];
    cells += rx * ry;
    across += c2 * rx + (1 - c2) * ry;
    down += (1 - c2) * rx + c2 * ry;
    horizontal.data[i] = c2;
  }
  const double factor = std::sqrt(cells / count);
  across /= factor * h;
  down /= factor * w;
  const std::array<double, 2> wished = {across / fit.stretch, down * fit.stretch};
  const auto [columns, rows] =
      fit.whole_cells ? whole_cells(wished[0], wished[1], fit.stretch_cost) : wished;
  const auto fit_x = static_cast<float>(factor * across / columns);
  const auto fit_y = static_cast<float>(factor * down / rows);
  ScaleField scale = relative;
  for (std::size_t i = 0; i < field.z.data.size(); ++i) {
    const float c2 = horizontal.data[i];
    scale.along_x.data[i] *= fit_x * c2 + fit_y * (1 - c2);
    scale.along_y.data[i] *= fit_x * (1 - c2) + fit_y * c2;
  }
  return scale;
}

}  // namespace quadrille
