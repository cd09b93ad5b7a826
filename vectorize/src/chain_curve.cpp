#include "chain_curve.h"

#include <algorithm>

namespace quadrille {

using Eigen::Vector2d;

std::vector<double> arc_lengths(const std::vector<Vector2d>& points) {
  std::vector<double> s(points.size(), 0);
  for (std::size_t i = 1; i < s.size(); ++i) s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
  return s;
}

ChainCurve::ChainCurve(const std::vector<Vector2d>& points)
    : points_(points), arc_(arc_lengths(points)) {}

Vector2d ChainCurve::at(double s) const {
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), s);
  const std::size_t i = std::clamp<std::ptrdiff_t>(after - arc_.begin() - 1, 0,
                                                   static_cast<std::ptrdiff_t>(points_.size()) - 2);
  const double size = arc_[i + 1] - arc_[i];
  const double t = size > 0 ? std::clamp((s - arc_[i]) / size, 0.0, 1.0) : 0;
  return points_[i] + t * (points_[i + 1] - points_[i]);
}

Vector2d ChainCurve::direction(double from, double to) const {
  const Vector2d chord = at(to) - at(from);
  const double length = chord.norm();
  return length > 0 ? Vector2d(chord / length) : Vector2d(1, 0);
}

}  // namespace quadrille
