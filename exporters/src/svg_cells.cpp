#include "svg_cells.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "patch_sides.h"
#include "svg_bleed.h"
#include "svg_path.h"
#include "svg_slope.h"

namespace quadrille {
namespace {

/// Cells are not divided across a side shorter than this, in pixels of the picture.
constexpr double kSmallestSide = 0.4;
/// What a path takes in a compressed file, in bytes: its element, and per character of its data.
constexpr double kPathBytes = 8, kPathDataBytes = 0.55;
/// And the same path again right after it.
constexpr double kRepeatedPathBytes = 10;
/// An error of alpha counts as much as one of each of several channels: it shows what lies below.
constexpr double kAlphaCounts = 6;
/// The least that another cell takes.
constexpr double kLeastCellBytes = 30;

class PatchDivider {
 public:
  PatchDivider(const SvgLayer& layer, int quad, CellPaint paint, const SvgDetail& detail)
      : quad_(quad),
        position_(layer.geometry(quad)),
        color_(layer.color(quad)),
        paint_(paint),
        price_(price_of(detail, paint)),
        units_(detail.units_per_pixel) {
    for (int k = 0; k < 4; ++k) is_cut_[k] = layer.is_cut(4 * quad + k);
  }

  std::vector<SvgCell> run() {
    const ParameterBox whole;
    return divide(whole, candidate(whole)).cells;
  }

 private:
  struct Candidate {
    SvgCell cell;
    double error = 0, cost = 0;
  };
  struct Division {
    std::vector<SvgCell> cells;
    double cost = 0;
  };

  Division divide(const ParameterBox& box, const Candidate& whole) const {
    Division undivided{{whole.cell}, whole.cost};
    if (whole.error <= price_ * kLeastCellBytes) return undivided;
    const bool divide_u = side_u(box) > kSmallestSide, divide_v = side_v(box) > kSmallestSide;
    if (!divide_u && !divide_v) return undivided;
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    const Boxes by_u{{{box.u0, box.v0, u, box.v1}, {u, box.v0, box.u1, box.v1}}};
    const Boxes by_v{{{box.u0, box.v0, box.u1, v}, {box.u0, v, box.u1, box.v1}}};
    Halves halves;
    Boxes boxes;
    if (divide_u && divide_v) {
      const Halves halves_u = candidates(by_u), halves_v = candidates(by_v);
      const bool u_wins = cost(halves_u) <= cost(halves_v);
      boxes = u_wins ? by_u : by_v;
      halves = u_wins ? halves_u : halves_v;
    } else {
      boxes = divide_u ? by_u : by_v;
      halves = candidates(boxes);
    }
    Division divided = divide(boxes[0], halves[0]);
    Division second = divide(boxes[1], halves[1]);
    divided.cost += second.cost;
    if (divided.cost >= undivided.cost) return undivided;
    divided.cells.insert(divided.cells.end(), std::make_move_iterator(second.cells.begin()),
                         std::make_move_iterator(second.cells.end()));
    return divided;
  }

  using Boxes = std::array<ParameterBox, 2>;
  using Halves = std::array<Candidate, 2>;

  Halves candidates(const Boxes& boxes) const { return {candidate(boxes[0]), candidate(boxes[1])}; }
  static double cost(const Halves& halves) { return halves[0].cost + halves[1].cost; }

  Candidate candidate(const ParameterBox& box) const {
    Candidate found{{{quad_, box}, samples(box), 0}, 0, 0};
    const PricedFill fill = priced_fill({outline(box)}, found.cell.samples, price_, units_);
    found.error = fill.error;
    found.cost = found.cell.cost = fill.cost;
    return found;
  }

  SvgOutline outline(const ParameterBox& box) const {
    constexpr int kPoints = 4;  // of a side
    OutlineSimplifier simplifier(kSeamFlatness);
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < kPoints; ++i) {
        const Eigen::Vector2d at = on_side(k, double(i) / kPoints);
        simplifier.add(
            position_.at(box.u0 + (box.u1 - box.u0) * at.x(), box.v0 + (box.v1 - box.v0) * at.y()));
      }
    }
    return simplifier.outline();
  }

  CellSamples samples(const ParameterBox& box) const {
    // Small cells show no more than a few samples can tell.
    constexpr int kLeast = 6;
    constexpr double kPerPixel = 1.5;
    const double longest = std::min(std::max(side_u(box), side_v(box)), 1e3);
    const int n = std::clamp(static_cast<int>(std::lround(kPerPixel * longest)), kLeast,
                             CellSamples::kMostAlong);
    const double middle = 0.5 * (n - 1);
    CellSamples samples;
    samples.count = n * n;
    samples.is_cut = (is_cut_[0] && box.v0 == 0) || (is_cut_[1] && box.u1 == 1) ||
                     (is_cut_[2] && box.v1 == 1) || (is_cut_[3] && box.u0 == 0);
    const double share = (box.u1 - box.u0) * (box.v1 - box.v0) / samples.count;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        // The grid is turned a little: samples in line with a gradient's stops could not tell what
        // happens between the stops.
        const double across = i - middle, down = j - middle;
        const double s = std::clamp(0.5 + (across + down / n) / (n - 1), 0.0, 1.0);
        const double t = std::clamp(0.5 + (down - across / n) / (n - 1), 0.0, 1.0);
        set_sample(samples, j * n + i, box.u0 + (box.u1 - box.u0) * s,
                   box.v0 + (box.v1 - box.v0) * t, share);
      }
    }
    return samples;
  }

  void set_sample(CellSamples& samples, int index, double u, double v, double share) const {
    const Color c = color_.at(u, v);
    const double alpha = std::clamp(double(c[3]), 0.0, 1.0);
    const Eigen::Vector2d du = position_.derivative_u(u, v), dv = position_.derivative_v(u, v);
    const double area = share * std::abs(du.x() * dv.y() - du.y() * dv.x());
    samples.position[index] = position_.at(u, v);
    if (paint_ == CellPaint::alpha) {
      samples.color[index] = Eigen::Array3d::Constant(255 * alpha);
      samples.weight[index] = area;
    } else {
      const double straight = 255 / std::max(alpha, 1e-3);
      samples.color[index] = (c.head<3>().cast<double>() * straight).max(0.0).min(255.0);
      samples.weight[index] = area * alpha * alpha;
    }
    const auto slopes = paint_slopes(position_, color_, paint_, u, v);
    samples.slopes += samples.weight[index] * (slopes.transpose() * slopes);
  }

  double side_u(const ParameterBox& box) const {
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    return position_.derivative_u(u, v).norm() * (box.u1 - box.u0);
  }
  double side_v(const ParameterBox& box) const {
    const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
    return position_.derivative_v(u, v).norm() * (box.v1 - box.v0);
  }

  int quad_;
  BicubicHermite<Eigen::Vector2d> position_;
  BicubicHermite<Color> color_;
  CellPaint paint_;
  double price_;
  int units_;
  std::array<bool, 4> is_cut_;  ///< per side of the patch
};

}  // namespace

double price_of(const SvgDetail& detail, CellPaint paint) {
  return paint == CellPaint::alpha ? detail.price / kAlphaCounts : detail.price;
}

PricedFill priced_fill(const std::vector<SvgOutline>& outlines, const CellSamples& samples,
                       double price, int units_per_pixel, double limit) {
  SvgPathData path(units_per_pixel);
  for (const SvgOutline& outline : outlines) path.append(outline);
  const double bytes = kPathBytes + kPathDataBytes * double(path.text().size());
  const CellFit fit =
      fit_cell(samples, path.bounds(), price, kRepeatedPathBytes, limit - price * bytes);
  return {fit.fill, fit.squared_error, fit.cost(price) + price * bytes};
}

std::vector<SvgCell> divide_into_cells(const SvgLayer& layer, int quad, CellPaint paint,
                                       const SvgDetail& detail) {
  return PatchDivider(layer, quad, paint, detail).run();
}

}  // namespace quadrille
