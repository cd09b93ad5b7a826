#include "svg_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "svg_ridge.h"

namespace quadrille {
namespace {

using Eigen::Array3d;

/// Stop counts that are tried.
constexpr int kCounts[] = {2, 3, 4, 6, 8};
/// With which the directions of two gradients are chosen, and the most of each of two.
constexpr int kScoutStops = 4, kMostOfTwo = 6;
/// Opacities of the second gradient, the least first: the first gradient alone is then nearest to
/// the whole, and half-covered pixels at seams err least.
constexpr double kOpacities[] = {0.2, 0.35, 0.5, 0.65};
/// By what factor the cost of two gradients may lie above the limit with scouts for stops.
constexpr double kHopeless = 2;
/// What the parts of a fill take in a compressed file, in bytes.
constexpr double kFlatBytes = 5, kGradientBytes = 11, kStopBytes = 5.7;

double gradient_bytes(int stops) { return kGradientBytes + kStopBytes * stops; }

/// Colours of the stops, one per row.
using Stops = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, LinearGradient::kMaxStops, 3>;

LinearGradient gradient_of(const RidgeAxis& axis, int direction, const Stops& stops) {
  LinearGradient gradient{.direction = direction,
                          .first = axis.first,
                          .last = axis.last,
                          .stop_count = static_cast<int>(stops.rows())};
  for (int k = 0; k < gradient.stop_count; ++k) {
    gradient.stops[k] = rounded_color(stops.row(k).transpose().array());
  }
  return gradient;
}

class CellFitter {
 public:
  CellFitter(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double price,
             double again, double limit)
      : s_(samples), price_(price), again_(again), limit_(limit) {
    for (int d = 0; d < LinearGradient::kDirections; ++d) {
      axes_[d] = ridge_axis(samples, bounds, d);
    }
    for (int i = 0; i < CellSamples::kCount; ++i) {
      total_ += s_.weight[i];
      mean_ += s_.weight[i] * s_.color[i];
      squares_ += s_.weight[i] * s_.color[i].square().sum();
    }
    if (total_ > 0) mean_ /= total_;
  }

  CellFit run() {
    CellFit best = flat();
    // Nothing more can pay when even a perfect fill would not.
    if (best.squared_error <= price_ * (gradient_bytes(2) - kFlatBytes)) return best;
    const CellFit one = single();
    if (one.cost(price_) < best.cost(price_)) best = one;
    if (one.squared_error <= price_ * (again_ + gradient_bytes(2))) return best;
    const std::optional<CellFit> two = pair();
    if (two && two->cost(price_) < best.cost(price_)) best = *two;
    return best;
  }

 private:
  CellFit flat() const {
    CellFit fit;
    fit.fill.base.stops[0] = rounded_color(mean_);
    fit.bytes = kFlatBytes;
    measure(fit);
    return fit;
  }

  CellFit single() const {
    double lowest = std::numeric_limits<double>::max();
    int direction = 0;
    RidgeSolution<RidgeSystem::kSize> best;
    for (const int stops : kCounts) {
      for (int d = 0; d < LinearGradient::kDirections; ++d) {
        const auto solution = solve_ridge(RidgeSystem(s_, axes_[d], stops));
        const double cost = (squares_ - solution.explained) / 3 + price_ * gradient_bytes(stops);
        if (cost < lowest) lowest = cost, direction = d, best = solution;
      }
    }
    CellFit fit;
    fit.fill.base = gradient_of(axes_[direction], direction, best.stops);
    fit.bytes = gradient_bytes(fit.fill.base.stop_count);
    measure(fit);
    return fit;
  }

  struct Pair {
    int direction[2] = {0, 0};
    int stops[2] = {kScoutStops, kScoutStops};
    double cost = std::numeric_limits<double>::max();
    RidgeSolution<2 * RidgeSystem::kSize> solution;
  };

  void try_pair(Pair& best, const RidgeSystem& a, int da, const RidgeSystem& b, int db) const {
    Pair pair{{da, db}, {a.stops, b.stops}, 0, solve_ridges(s_, a, b)};
    pair.cost = (squares_ - pair.solution.explained) / 3 +
                price_ * (gradient_bytes(a.stops) + gradient_bytes(b.stops) + again_);
    if (pair.cost < best.cost) best = pair;
  }

  std::optional<CellFit> pair() const {
    std::array<RidgeSystem, LinearGradient::kDirections> scouts;
    for (int d = 0; d < LinearGradient::kDirections; ++d) {
      scouts[d] = RidgeSystem(s_, axes_[d], kScoutStops);
    }
    Pair best;
    for (int a = 0; a < LinearGradient::kDirections; ++a) {
      for (int b = a + 1; b < LinearGradient::kDirections; ++b) {
        try_pair(best, scouts[a], a, scouts[b], b);
      }
    }
    // Other numbers of stops rarely save more than this.
    if (best.cost > kHopeless * limit_) return {};
    const auto [a, b] = best.direction;
    std::vector<RidgeSystem> systems[2];
    for (const int stops : kCounts) {
      if (stops > kMostOfTwo) continue;
      systems[0].emplace_back(s_, axes_[a], stops);
      systems[1].emplace_back(s_, axes_[b], stops);
    }
    for (const RidgeSystem& system_a : systems[0]) {
      for (const RidgeSystem& system_b : systems[1]) try_pair(best, system_a, a, system_b, b);
    }
    return layered(best);
  }

  /// The two gradients whose mixture is the sum that was found.
  std::optional<CellFit> layered(const Pair& pair) const {
    Stops part[2] = {pair.solution.stops.topRows(pair.stops[0]),
                     pair.solution.stops.bottomRows(pair.stops[1])};
    const auto range = [](const Stops& stops) {
      return (stops.colwise().maxCoeff() - stops.colwise().minCoeff()).sum();
    };
    const int over = range(part[0]) < range(part[1]) ? 0 : 1;  // the smaller part
    const int under = 1 - over;
    std::optional<CellFit> best;
    for (const double opacity : kOpacities) {
      Stops base = part[under], overlay = part[over];
      const bool fits = share(base, overlay, opacity);
      CellFit fit;
      const int d0 = pair.direction[under], d1 = pair.direction[over];
      fit.fill.base = gradient_of(axes_[d0], d0, base / (1 - opacity));
      fit.fill.overlay = gradient_of(axes_[d1], d1, overlay / opacity);
      fit.fill.overlay_opacity = opacity;
      fit.bytes = gradient_bytes(pair.stops[0]) + gradient_bytes(pair.stops[1]) + again_;
      measure(fit);
      if (!best || fit.squared_error < best->squared_error) best = fit;
      if (fits) break;
    }
    return best;
  }

  /// Moves a constant from one summand to the other so that both can be shown, each channel as near
  /// as can be to the cell's mean colour. False where colours would leave the range.
  bool share(Stops& base, Stops& overlay, double opacity) const {
    bool fits = true;
    for (int c = 0; c < 3; ++c) {
      auto low = base.col(c), high = overlay.col(c);
      const double wished = opacity * mean_[c] - high.mean();
      const double least = std::max(-high.minCoeff(), low.maxCoeff() - 255 * (1 - opacity));
      const double most = std::min(255 * opacity - high.maxCoeff(), low.minCoeff());
      fits = fits && least <= most + 1;
      const double shift = least <= most ? std::clamp(wished, least, most) : 0.5 * (least + most);
      high.array() += shift;
      low.array() -= shift;
    }
    return fits;
  }

  void measure(CellFit& fit) const {
    double sum = 0;
    const LinearGradient &base = fit.fill.base, &overlay = fit.fill.overlay;
    const double opacity = fit.fill.overlay_opacity;
    for (int i = 0; i < CellSamples::kCount; ++i) {
      Array3d drawn = color_at(base, axes_[base.direction].place[i]);
      if (opacity > 0) {
        drawn += opacity * (color_at(overlay, axes_[overlay.direction].place[i]) - drawn);
      }
      sum += s_.weight[i] * (drawn - s_.color[i]).square().sum();
    }
    fit.squared_error = sum / 3;
  }

  static Array3d color_at(const LinearGradient& gradient, double place) {
    const auto stop = [&](int k) -> Array3d {
      const LinearGradient::Rgb& c = gradient.stops[k];
      return {double(c[0]), double(c[1]), double(c[2])};
    };
    if (gradient.stop_count == 1) return stop(0);
    const RidgePlace at = ridge_place(place, gradient.stop_count);
    return stop(at.interval) * (1 - at.fraction) + stop(at.interval + 1) * at.fraction;
  }

  const CellSamples& s_;
  double price_, again_, limit_;
  std::array<RidgeAxis, LinearGradient::kDirections> axes_;
  double total_ = 0, squares_ = 0;
  Array3d mean_ = Array3d::Zero();
};

}  // namespace

LinearGradient::Rgb rounded_color(const Array3d& color) {
  LinearGradient::Rgb rgb;
  for (int k = 0; k < 3; ++k) {
    rgb[k] = static_cast<std::uint8_t>(std::lround(std::clamp(color[k], 0.0, 255.0)));
  }
  return rgb;
}

CellFit fit_cell(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double price,
                 double again, double limit) {
  return CellFitter(samples, bounds, price, again, limit).run();
}

}  // namespace quadrille
