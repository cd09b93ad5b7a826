#include "quadrille/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr int kWindow = 7;

double to_byte(float value) {
  return std::floor(std::clamp(static_cast<double>(value), 0.0, 1.0) * 255 + 0.5);
}

/// Channel c in 0..255: what an 8-bit file of the picture shows over white.
double shown(const float* pixel, int c, bool has_alpha) {
  const double value = to_byte(pixel[c]);
  if (!has_alpha) return value;
  const double alpha = to_byte(pixel[3]) / 255;
  return value * alpha + 255 * (1 - alpha);
}

/// Sums of the two pictures' samples, their squares and their product.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double x, double y, double sign) {
    a += sign * x, b += sign * y;
    aa += sign * x * x, bb += sign * y * y, ab += sign * x * y;
  }
  void add(const Moments& m, double sign) {
    a += sign * m.a, b += sign * m.b;
    aa += sign * m.aa, bb += sign * m.bb, ab += sign * m.ab;
  }
};

/// Wang et al. 2004, Eq. 13, from the moments of one window.
double similarity(const Moments& m) {
  constexpr double kCount = kWindow * kWindow;
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  const double mean_a = m.a / kCount, mean_b = m.b / kCount;
  const double sample = kCount / (kCount - 1);
  const double var_a = sample * (m.aa / kCount - mean_a * mean_a);
  const double var_b = sample * (m.bb / kCount - mean_b * mean_b);
  const double covariance = sample * (m.ab / kCount - mean_a * mean_b);
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

/// Mean over all windows inside the picture, by sums that run down the columns and along the rows.
double channel_ssim(const Raster& a, const Raster& b, int c) {
  const int w = a.width, h = a.height;
  std::vector<Moments> columns(w);
  const auto add_row = [&](int y, double sign) {
    for (int x = 0; x < w; ++x) {
      columns[x].add(shown(a.pixel(x, y), c, a.has_alpha()), shown(b.pixel(x, y), c, b.has_alpha()),
                     sign);
    }
  };
  double total = 0;
  for (int y = 0; y < h; ++y) {
    add_row(y, 1);
    if (y >= kWindow) add_row(y - kWindow, -1);
    if (y < kWindow - 1) continue;
    Moments window;
    double row = 0;
    for (int x = 0; x < w; ++x) {
      window.add(columns[x], 1);
      if (x >= kWindow) window.add(columns[x - kWindow], -1);
      if (x >= kWindow - 1) row += similarity(window);
    }
    total += row;
  }
  return total / (static_cast<double>(w - kWindow + 1) * (h - kWindow + 1));
}

std::string size_of(const Raster& r) {
  return std::to_string(r.width) + " x " + std::to_string(r.height);
}

}  // namespace

ImageDifference compare(const Raster& a, const Raster& b) {
  if (a.width != b.width || a.height != b.height) {
    throw Error(ErrorCode::invalid_argument, "pictures of " + size_of(a) + " and " + size_of(b) +
                                                 " pixels cannot be compared; bring them to the "
                                                 "same size");
  }
  ImageDifference result;
  double sum = 0, squares = 0;
  for (int y = 0; y < a.height; ++y) {
    double row_sum = 0, row_squares = 0;
    for (int x = 0; x < a.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double d = std::abs(shown(a.pixel(x, y), c, a.has_alpha()) -
                                  shown(b.pixel(x, y), c, b.has_alpha()));
        row_sum += d;
        row_squares += d * d;
        result.max_error = std::max(result.max_error, d);
      }
    }
    sum += row_sum;
    squares += row_squares;
  }
  const double samples = 3.0 * a.width * a.height;
  constexpr double kIdentical = 99;
  result.mae = sum / samples;
  result.psnr = squares > 0
                    ? std::min(kIdentical, 10 * std::log10(255.0 * 255.0 * samples / squares))
                    : kIdentical;
  result.ssim = std::min(a.width, a.height) < kWindow
                    ? std::numeric_limits<double>::quiet_NaN()
                    : (channel_ssim(a, b, 0) + channel_ssim(a, b, 1) + channel_ssim(a, b, 2)) / 3;
  return result;
}

}  // namespace quadrille
