#include "svg_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrille {
namespace {

using Eigen::Array3f;
using Eigen::Vector2d;

GradientFill::Rgb rounded(const Array3f& color) {
  GradientFill::Rgb rgb;
  for (int k = 0; k < 3; ++k) {
    rgb[k] = static_cast<std::uint8_t>(std::lround(std::clamp(color[k], 0.0f, 255.0f)));
  }
  return rgb;
}

Array3f to_array(const GradientFill::Rgb& rgb) {
  return {float(rgb[0]), float(rgb[1]), float(rgb[2])};
}

float total_weight(const CellSamples& s) {
  float sum = 0;
  for (const float w : s.weight) sum += w;
  return sum;
}

/// What a fill misses by; see GradientFit::error.
class ErrorMeter {
 public:
  void add(const Array3f& difference, float weight) {
    const float squared = weight * weight * difference.square().sum() / 3;
    largest_ = std::max(largest_, squared);
    sum_ += squared;
  }
  double error() const {
    const double mean = double(sum_) / CellSamples::kCount;
    return std::max(0.5 * std::sqrt(double(largest_)), 2 * std::sqrt(mean));
  }

 private:
  float largest_ = 0, sum_ = 0;
};

GradientFit fit_flat(const CellSamples& s) {
  Array3f low = Array3f::Constant(255), high = Array3f::Zero();
  for (int i = 0; i < CellSamples::kCount; ++i) {
    if (s.weight[i] <= 0) continue;
    low = low.min(s.color[i]);
    high = high.max(s.color[i]);
  }
  GradientFit fit;
  fit.fill.stops[0] = rounded((low + high) / 2);
  const Array3f flat = to_array(fit.fill.stops[0]);
  ErrorMeter meter;
  for (int i = 0; i < CellSamples::kCount; ++i) meter.add(s.color[i] - flat, s.weight[i]);
  fit.error = meter.error();
  return fit;
}

/// Places of the samples along a direction, scaled to [0, 1].
struct Projection {
  Vector2d from = {0, 0}, to = {0, 0};
  std::array<float, CellSamples::kCount> place{};
};

Projection project(const CellSamples& s, const Vector2d& direction) {
  std::array<double, CellSamples::kCount> along;
  double low = std::numeric_limits<double>::max(), high = -low;
  Vector2d middle = Vector2d::Zero();
  for (int i = 0; i < CellSamples::kCount; ++i) {
    along[i] = s.position[i].dot(direction);
    low = std::min(low, along[i]);
    high = std::max(high, along[i]);
    middle += s.position[i] / CellSamples::kCount;
  }
  const double at_middle = middle.dot(direction), length = std::max(high - low, 1e-9);
  Projection projection;
  projection.from = middle + direction * (low - at_middle);
  projection.to = middle + direction * (high - at_middle);
  for (int i = 0; i < CellSamples::kCount; ++i) {
    projection.place[i] = static_cast<float>((along[i] - low) / length);
  }
  return projection;
}

/// Stop colours by weighted least squares: the normal matrix of a linear spline is tridiagonal.
GradientFit fit_stops(const CellSamples& s, const Projection& projection, int stops) {
  std::array<float, GradientFill::kMaxStops> diagonal{}, beside{};
  std::array<Array3f, GradientFill::kMaxStops> color;
  color.fill(Array3f::Zero());
  std::array<int, CellSamples::kCount> interval;
  std::array<float, CellSamples::kCount> fraction;
  for (int i = 0; i < CellSamples::kCount; ++i) {
    const float x = projection.place[i] * float(stops - 1);
    const int k = std::clamp(static_cast<int>(x), 0, stops - 2);
    const float f = x - float(k), w = s.weight[i];
    interval[i] = k;
    fraction[i] = f;
    diagonal[k] += w * (1 - f) * (1 - f);
    diagonal[k + 1] += w * f * f;
    beside[k] += w * f * (1 - f);
    color[k] += s.color[i] * (w * (1 - f));
    color[k + 1] += s.color[i] * (w * f);
  }
  // Pulls a stop without samples toward its neighbours.
  const float smoothing = 1e-4f * total_weight(s) / float(stops) + 1e-9f;
  for (int k = 0; k + 1 < stops; ++k) {
    diagonal[k] += smoothing;
    diagonal[k + 1] += smoothing;
    beside[k] -= smoothing;
  }
  diagonal[0] += 1e-6f * smoothing + 1e-12f;
  for (int k = 1; k < stops; ++k) {
    const float factor = beside[k - 1] / diagonal[k - 1];
    diagonal[k] -= factor * beside[k - 1];
    color[k] -= factor * color[k - 1];
  }
  for (int k = stops - 1; k >= 0; --k) {
    if (k + 1 < stops) color[k] -= beside[k] * color[k + 1];
    color[k] /= diagonal[k];
  }

  GradientFit fit;
  fit.fill = {.from = projection.from, .to = projection.to, .stop_count = stops};
  for (int k = 0; k < stops; ++k) {
    fit.fill.stops[k] = rounded(color[k]);
    color[k] = to_array(fit.fill.stops[k]);
  }
  ErrorMeter meter;
  for (int i = 0; i < CellSamples::kCount; ++i) {
    const int k = interval[i];
    const Array3f drawn = color[k] + (color[k + 1] - color[k]) * fraction[i];
    meter.add(s.color[i] - drawn, s.weight[i]);
  }
  fit.error = meter.error();
  return fit;
}

/// The direction in the picture along which the colours change most: the first eigenvector of the
/// sum of grad c grad c^T over the quads of the sample grid.
double angle_of_change(const CellSamples& s) {
  double xx = 0, xy = 0, yy = 0;
  constexpr int n = CellSamples::kSide;
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      const Vector2d pu = s.position[b] - s.position[a] + s.position[d] - s.position[c];
      const Vector2d pv = s.position[c] - s.position[a] + s.position[d] - s.position[b];
      const double area = pu.x() * pv.y() - pu.y() * pv.x();
      if (std::abs(area) < 1e-12) continue;
      const Array3f cu = s.color[b] - s.color[a] + s.color[d] - s.color[c];
      const Array3f cv = s.color[c] - s.color[a] + s.color[d] - s.color[b];
      const Array3f gx = (cu * float(pv.y()) - cv * float(pu.y())) / float(area);
      const Array3f gy = (cv * float(pu.x()) - cu * float(pv.x())) / float(area);
      const double w = s.weight[a];
      xx += w * (gx * gx).sum();
      xy += w * (gx * gy).sum();
      yy += w * (gy * gy).sum();
    }
  }
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

}  // namespace

GradientFit fit_gradient(const CellSamples& samples, double tolerance) {
  const GradientFit flat = fit_flat(samples);
  if (flat.error <= tolerance) return flat;

  const double angle = angle_of_change(samples);
  constexpr double kTurns[] = {0, 0.12, -0.12, 0.3, -0.3};
  GradientFit best;
  Projection best_projection;
  best.error = std::numeric_limits<double>::max();
  for (const double turn : kTurns) {
    const Projection projection =
        project(samples, Vector2d(std::cos(angle + turn), std::sin(angle + turn)));
    const GradientFit fit = fit_stops(samples, projection, GradientFill::kMaxStops);
    if (fit.error < best.error) best = fit, best_projection = projection;
    // A cell that misses by far along its main direction needs to be divided anyway.
    if (turn == 0 && fit.error > 3 * tolerance) return fit;
  }
  if (best.error > tolerance) return best;
  for (int stops = 2; stops < GradientFill::kMaxStops; ++stops) {
    const GradientFit fit = fit_stops(samples, best_projection, stops);
    if (fit.error <= tolerance) return fit;
  }
  return best;
}

}  // namespace quadrille
