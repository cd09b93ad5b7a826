#include "svg_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// Farthest that a straight line may be from an exact curve it stands for, in pixels.
constexpr double kExactFlatness = 0.01;
/// Points are exact below this share of the tolerance; the least tolerance, in pixels.
constexpr double kExactShare = 0.8, kLeastTolerance = 0.02;

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d chord = b - a;
  const double length2 = chord.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(chord) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * chord).norm();
}

}  // namespace

void OutlineSimplifier::add(const Vector2d& point, double tolerance) {
  steps_.push_back({false, tolerance < kExactShare * tolerance_, point, point, point,
                    std::min(tolerance_, std::max(tolerance, kLeastTolerance))});
}

bool OutlineSimplifier::ends_curve(std::size_t i) const {
  return steps_[(i + steps_.size() - 1) % steps_.size()].is_curve;
}

/// A point that is kept for sure: an end of an exact curve, or an extreme one.
std::size_t OutlineSimplifier::anchor() const {
  std::size_t best = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].is_curve) return i;
    if (steps_[i].point.sum() < steps_[best].point.sum()) best = i;
  }
  return best;
}

void OutlineSimplifier::keep_between(std::size_t first, std::size_t last,
                                     std::vector<char>& kept) const {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Vector2d from = steps_[a].point, to = steps_[b % steps_.size()].point;
    double farthest = 1;
    std::size_t middle = 0;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double distance = distance_to_segment(steps_[i].point, from, to) / steps_[i].tolerance;
      if (distance > farthest) farthest = distance, middle = i;
    }
    if (middle == 0) continue;
    kept[middle] = 1;
    open.emplace_back(a, middle);
    open.emplace_back(middle, b);
  }
}

SvgOutline OutlineSimplifier::outline() {
  SvgOutline outline;
  const std::size_t count = steps_.size();
  if (count == 0) return outline;
  std::rotate(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(anchor()), steps_.end());
  std::vector<char> kept(count, 0);
  kept[0] = 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (steps_[i].is_curve || ends_curve(i)) kept[i] = 1;
  }
  for (std::size_t first = 0; first < count;) {
    std::size_t last = first + 1;
    while (last < count && !kept[last]) ++last;
    keep_between(first, last, kept);
    first = last;
  }
  outline.start = steps_[0].point;
  for (std::size_t i = 0; i < count;) {
    const Step& step = steps_[i];
    std::size_t next = i + 1;
    while (next < count && !kept[next]) ++next;
    const Vector2d end = steps_[next % count].point;
    const bool is_exact = step.is_exact || steps_[next % count].is_exact;
    const bool is_line = !step.is_curve || chord_distance({step.point, step.control1, step.control2,
                                                           end}) <= kExactFlatness;
    outline.pieces.push_back({is_line, step.control1, step.control2, end, is_exact});
    i = next;
  }
  return outline;
}

}  // namespace quadrille
