#include "svg_gradient.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

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
/// By what factor a cost may lie above the limit with scouts for stops: other numbers of stops and
/// other directions rarely save more.
constexpr double kHopeless = 2;
/// In so many of the common directions, those with the best scouts, other numbers are tried; the
/// sums of two have one of these or the cell's own direction.
constexpr int kPromising = 2;
/// What the parts of a fill take, in bytes of a compressed file. Gradients count about 9 more than
/// they have there and stops 2, for the time that a browser takes for their elements.
constexpr double kFlatBytes = 5, kGradientBytes = 20, kStopBytes = 8;
constexpr double kOwnVectorBytes = 10;
/// Angles from the steepest one at which an own vector is tried as well, in turns halved.
constexpr double kFirstTurn = std::numbers::pi / 24;
constexpr int kTurns = 3;

double gradient_bytes(const RidgeAxis& axis, int stops) {
  return kGradientBytes + (axis.vector.is_common ? 0 : kOwnVectorBytes) + kStopBytes * stops;
}
/// Those of the smallest gradient.
constexpr double kLeastGradientBytes = kGradientBytes + 2 * kStopBytes;

/// Colours of evenly spaced stops, one per row, and which of them are left out.
struct Stops {
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, LinearGradient::kMaxStops, 3> colors;
  std::bitset<LinearGradient::kMaxStops> left_out;
};

LinearGradient gradient_of(const RidgeAxis& axis, const Stops& stops) {
  LinearGradient gradient{.vector = axis.vector, .stop_count = 0};
  const int n = static_cast<int>(stops.colors.rows());
  for (int k = 0; k < n; ++k) {
    if (stops.left_out[k]) continue;
    gradient.stops[gradient.stop_count++] = {
        double(k) / (n - 1), rounded_color(stops.colors.row(k).transpose().array())};
  }
  return gradient;
}

class CellFitter {
 public:
  CellFitter(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double price,
             double again, double limit)
      : s_(samples),
        colors_(samples),
        bounds_(bounds),
        price_(price),
        again_(samples.is_cut ? std::numeric_limits<double>::infinity() : again),
        limit_(limit) {
    for (int d = 0; d < kCommonDirections; ++d) axes_[d] = common_axis(samples, bounds, d);
    for (int i = 0; i < s_.count; ++i) {
      total_ += s_.weight[i];
      mean_ += s_.weight[i] * s_.color[i];
      squares_ += s_.weight[i] * s_.color[i].square().sum();
    }
    if (total_ > 0) mean_ /= total_;
  }

  CellFit run() {
    CellFit best = flat();
    // Nothing more can pay when even a perfect fill would not.
    if (best.squared_error <= price_ * (kLeastGradientBytes - kFlatBytes)) return best;
    send_scouts();
    if (is_hopeless()) return best;
    const CellFit one = single();
    if (one.cost(price_) < best.cost(price_)) best = one;
    if (one.squared_error <= price_ * (again_ + kLeastGradientBytes)) return best;
    const std::optional<CellFit> two = pair();
    if (two && two->cost(price_) < best.cost(price_)) best = *two;
    return best;
  }

 private:
  CellFit flat() const {
    CellFit fit;
    fit.fill.base.stops[0].color = rounded_color(mean_);
    fit.bytes = kFlatBytes;
    measure(fit, axes_[0], axes_[0]);
    return fit;
  }

  struct Ridge {
    RidgeAxis axis;
    RidgeSolution<RidgeSystem::kSize> solution;
    double cost = std::numeric_limits<double>::max();
    int stops() const { return static_cast<int>(solution.stops.rows()); }
  };

  /// True when it is better.
  bool try_ridge(Ridge& best, const RidgeAxis& axis, int stops) const {
    return try_ridge(best, axis, RidgeSystem(colors_, axis, stops));
  }
  bool try_ridge(Ridge& best, const RidgeAxis& axis, const RidgeSystem& system) const {
    const int stops = system.stops;
    const auto solution = solve_ridge(system);
    const double cost = (squares_ - solution.explained) / 3 + price_ * gradient_bytes(axis, stops);
    if (cost >= best.cost) return false;
    best = {axis, solution, cost};
    return true;
  }

  void send_scouts() {
    for (int d = 0; d < kCommonDirections; ++d) {
      scouts_[d] = RidgeSystem(colors_, axes_[d], kScoutStops);
      try_ridge(single_scouts_[d], axes_[d], scouts_[d]);
    }
    std::iota(by_scouts_.begin(), by_scouts_.end(), 0);
    std::sort(by_scouts_.begin(), by_scouts_.end(),
              [&](int a, int b) { return single_scouts_[a].cost < single_scouts_[b].cost; });
  }

  /// Goes by the common directions and the sums of two that are perpendicular.
  bool is_hopeless() const {
    const double most = kHopeless * limit_;
    for (const Ridge& scout : single_scouts_) {
      if (scout.cost <= most) return false;
    }
    Pair best;
    constexpr int kHalf = kCommonDirections / 2;
    for (int d = 0; d < kHalf; ++d) try_pair(best, scouts_[d], d, scouts_[d + kHalf], d + kHalf);
    return best.cost > most;
  }

  /// About the best axis of the cell's own.
  Ridge own() const {
    Ridge best;
    double angle = steepest_angle(s_, bounds_);
    const RidgeAxis steepest = own_axis(s_, bounds_, angle);
    for (const int stops : kCounts) try_ridge(best, steepest, stops);
    double turn = kFirstTurn;
    for (int i = 0; i < kTurns; ++i, turn *= 0.5) {
      for (const double turned : {angle - turn, angle + turn}) {
        if (!try_ridge(best, own_axis(s_, bounds_, turned), best.stops())) continue;
        angle = turned;
        break;
      }
    }
    return best;
  }

  CellFit single() {
    Ridge best = own();
    axes_[kOwn] = best.axis;
    for (int i = 0; i < kPromising; ++i) {
      for (const int stops : kCounts) try_ridge(best, axes_[by_scouts_[i]], stops);
    }
    const auto thin = thinned_ridge(RidgeSystem(colors_, best.axis, best.stops()), worth_of_stop());
    CellFit fit;
    fit.fill.base = gradient_of(best.axis, {thin.stops, thin.left_out});
    fit.bytes = gradient_bytes(best.axis, fit.fill.base.stop_count);
    measure(fit, best.axis, best.axis);
    return fit;
  }

  /// The squares by which the sum over the channels may rise where that saves a stop.
  double worth_of_stop() const { return 3 * price_ * kStopBytes; }

  struct Pair {
    int direction[2] = {0, 0};
    int stops[2] = {kScoutStops, kScoutStops};
    double cost = std::numeric_limits<double>::max();
    RidgeSolution<2 * RidgeSystem::kSize> solution;
  };

  void try_pair(Pair& best, const RidgeSystem& a, int da, const RidgeSystem& b, int db) const {
    Pair pair{{da, db}, {a.stops, b.stops}, 0, solve_ridges(colors_, a, b)};
    pair.cost =
        (squares_ - pair.solution.explained) / 3 +
        price_ * (gradient_bytes(axes_[da], a.stops) + gradient_bytes(axes_[db], b.stops) + again_);
    if (pair.cost < best.cost) best = pair;
  }

  std::optional<CellFit> pair() {
    scouts_[kOwn] = RidgeSystem(colors_, axes_[kOwn], kScoutStops);
    Pair best;
    for (int i = 0; i < kPromising + 1; ++i) {
      const int a = i == 0 ? kOwn : by_scouts_[i - 1];
      for (int j = i; j < kCommonDirections; ++j) {
        const int b = by_scouts_[j];
        try_pair(best, scouts_[a], a, scouts_[b], b);
      }
    }
    if (best.cost > kHopeless * limit_) return {};
    for (int side = 0; side < 2; ++side) {
      const int changed = best.direction[side], other = best.direction[1 - side];
      const RidgeSystem kept(colors_, axes_[other], best.stops[1 - side]);
      for (const int stops : kCounts) {
        if (stops > kMostOfTwo || stops == kScoutStops) continue;
        try_pair(best, RidgeSystem(colors_, axes_[changed], stops), changed, kept, other);
      }
    }
    best.solution = thinned_ridges(
        colors_, RidgeSystem(colors_, axes_[best.direction[0]], best.stops[0]),
        RidgeSystem(colors_, axes_[best.direction[1]], best.stops[1]), worth_of_stop());
    return layered(best);
  }

  /// The two gradients whose mixture is the sum that was found.
  std::optional<CellFit> layered(const Pair& pair) const {
    const auto part_of = [&](int first, int count) {
      Stops stops{pair.solution.stops.middleRows(first, count), {}};
      for (int k = 0; k < count; ++k) stops.left_out[k] = pair.solution.left_out[first + k];
      return stops;
    };
    const Stops part[2] = {part_of(0, pair.stops[0]), part_of(pair.stops[0], pair.stops[1])};
    const auto range = [](const Stops& stops) {
      return (stops.colors.colwise().maxCoeff() - stops.colors.colwise().minCoeff()).sum();
    };
    const int over = range(part[0]) < range(part[1]) ? 0 : 1;  // the smaller part
    const int under = 1 - over;
    std::optional<CellFit> best;
    for (const double opacity : kOpacities) {
      Stops base = part[under], overlay = part[over];
      const bool fits = share(base, overlay, opacity);
      CellFit fit;
      const RidgeAxis &lower = axes_[pair.direction[under]], &upper = axes_[pair.direction[over]];
      base.colors /= 1 - opacity;
      overlay.colors /= opacity;
      fit.fill.base = gradient_of(lower, base);
      fit.fill.overlay = gradient_of(upper, overlay);
      fit.fill.overlay_opacity = opacity;
      fit.bytes = gradient_bytes(lower, fit.fill.base.stop_count) +
                  gradient_bytes(upper, fit.fill.overlay.stop_count) + again_;
      measure(fit, lower, upper);
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
      auto low = base.colors.col(c), high = overlay.colors.col(c);
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

  void measure(CellFit& fit, const RidgeAxis& lower, const RidgeAxis& upper) const {
    double sum = 0;
    const LinearGradient &base = fit.fill.base, &overlay = fit.fill.overlay;
    const double opacity = fit.fill.overlay_opacity;
    for (int i = 0; i < s_.count; ++i) {
      Array3d drawn = color_at(base, lower.place[i]);
      if (opacity > 0) {
        drawn += opacity * (color_at(overlay, upper.place[i]) - drawn);
      }
      sum += s_.weight[i] * (drawn - s_.color[i]).square().sum();
    }
    fit.squared_error = sum / 3;
  }

  static Array3d color_at(const LinearGradient& gradient, double place) {
    const auto color = [&](int k) -> Array3d {
      const LinearGradient::Rgb& c = gradient.stops[k].color;
      return {double(c[0]), double(c[1]), double(c[2])};
    };
    if (gradient.stop_count == 1) return color(0);
    int next = 1;
    while (next + 1 < gradient.stop_count && gradient.stops[next].offset < place) ++next;
    const double from = gradient.stops[next - 1].offset, to = gradient.stops[next].offset;
    const double f = std::clamp((place - from) / (to - from), 0.0, 1.0);
    return color(next - 1) * (1 - f) + color(next) * f;
  }

  static constexpr int kOwn = kCommonDirections, kAxes = kOwn + 1;

  const CellSamples& s_;
  WeightedColors colors_;
  const Eigen::AlignedBox2d& bounds_;
  double price_, again_, limit_;
  std::array<RidgeAxis, kAxes> axes_;      ///< the common ones, then the cell's own
  std::array<RidgeSystem, kAxes> scouts_;  // kScoutStops along each axis
  std::array<Ridge, kCommonDirections> single_scouts_;
  std::array<int, kCommonDirections> by_scouts_{};  // the best first
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
