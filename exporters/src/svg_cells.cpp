#include "svg_cells.h"

#include <algorithm>
#include <cmath>

namespace quadrille {
namespace {

/// Cells are not divided across a side shorter than this, in pixels of the picture.
constexpr double kSmallestSide = 0.5;

class PatchDivider {
 public:
  PatchDivider(const BicubicHermite<Eigen::Vector2d>& geometry, const BicubicHermite<Color>& color,
               CellPaint paint, double tolerance)
      : position_(geometry), color_(color), paint_(paint), tolerance_(tolerance) {}

  std::vector<SvgCell> run() {
    const ParameterBox whole;
    divide(whole, fit(whole));
    return std::move(cells_);
  }

 private:
  void divide(const ParameterBox& box, const GradientFit& found) {
    const bool divide_u = found.error > tolerance_ && side_u(box) > kSmallestSide;
    const bool divide_v = found.error > tolerance_ && side_v(box) > kSmallestSide;
    if (!divide_u && !divide_v) {
      cells_.push_back({box, found.fill});
      return;
    }
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    const Halves by_u{{{box.u0, box.v0, u, box.v1}, {u, box.v0, box.u1, box.v1}}};
    const Halves by_v{{{box.u0, box.v0, box.u1, v}, {box.u0, v, box.u1, box.v1}}};
    if (divide_u && divide_v) {
      const Fits fits_u = fit(by_u), fits_v = fit(by_v);
      cost(fits_u) <= cost(fits_v) ? divide(by_u, fits_u) : divide(by_v, fits_v);
    } else {
      divide_u ? divide(by_u, fit(by_u)) : divide(by_v, fit(by_v));
    }
  }

  using Halves = std::array<ParameterBox, 2>;
  using Fits = std::array<GradientFit, 2>;

  void divide(const Halves& halves, const Fits& fits) {
    for (int k = 0; k < 2; ++k) divide(halves[k], fits[k]);
  }
  Fits fit(const Halves& halves) const { return {fit(halves[0]), fit(halves[1])}; }

  /// About how many bytes the halves will take in a compressed file, by which two ways to divide
  /// are compared; a half whose error is too large needs about as many cells as it misses by.
  double cost(const Fits& fits) const {
    double bytes = 0;
    for (const GradientFit& f : fits) {
      const bool fits_well = f.error <= tolerance_;
      bytes += fits_well ? 32 + 6 * f.fill.stop_count : 30 + 60 * f.error / tolerance_;
    }
    return bytes;
  }

  GradientFit fit(const ParameterBox& box) const {
    constexpr int n = CellSamples::kSide;
    constexpr double kMiddle = 0.5 * (n - 1);
    CellSamples samples;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        // The grid is turned a little: samples in line with a gradient's stops could not tell what
        // happens between the stops.
        const double across = i - kMiddle, down = j - kMiddle;
        const double s = std::clamp(0.5 + (across + down / n) / (n - 1), 0.0, 1.0);
        const double t = std::clamp(0.5 + (down - across / n) / (n - 1), 0.0, 1.0);
        set_sample(samples, j * n + i, box.u0 + (box.u1 - box.u0) * s,
                   box.v0 + (box.v1 - box.v0) * t);
      }
    }
    return fit_gradient(samples, tolerance_);
  }

  void set_sample(CellSamples& samples, int index, double u, double v) const {
    const Color c = color_.at(u, v);
    const float alpha = std::clamp(c[3], 0.0f, 1.0f);
    samples.position[index] = position_.at(u, v);
    if (paint_ == CellPaint::alpha) {
      samples.color[index] = Eigen::Array3f::Constant(255 * alpha);
      samples.weight[index] = 1;
    } else {
      const float straight = 255 / std::max(alpha, 1e-3f);
      samples.color[index] = (c.head<3>() * straight).max(0.0f).min(255.0f);
      samples.weight[index] = alpha;
    }
  }

  double side_u(const ParameterBox& box) const {
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    return position_.derivative_u(u, v).norm() * (box.u1 - box.u0);
  }
  double side_v(const ParameterBox& box) const {
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    return position_.derivative_v(u, v).norm() * (box.v1 - box.v0);
  }

  const BicubicHermite<Eigen::Vector2d>& position_;
  const BicubicHermite<Color>& color_;
  CellPaint paint_;
  double tolerance_;
  std::vector<SvgCell> cells_;
};

}  // namespace

std::vector<SvgCell> divide_into_cells(const BicubicHermite<Eigen::Vector2d>& geometry,
                                       const BicubicHermite<Color>& color, CellPaint paint,
                                       double tolerance) {
  return PatchDivider(geometry, color, paint, tolerance).run();
}

}  // namespace quadrille
