#include "contour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSmoothing = 1.5;  // pixels on either side
// A corner turns within a short arm, and its longer arms show that it is not noise.
constexpr double kShortArm = 1.5, kLongArm = 3;  // pixels
constexpr double kShortTurn = 45 * kDegree, kLongTurn = 50 * kDegree, kMeshTurn = 40 * kDegree;
constexpr double kMeshArm = 0.25;                                                    // spacings
constexpr double kLeastCornerLoop = 12, kLeastFrameRun = 1.5, kMarkDistance = 0.75;  // pixels

bool is_marked(const std::vector<double>& marks, const Contour& contour, double s,
               double distance) {
  return std::any_of(marks.begin(), marks.end(),
                     [&](double m) { return contour.distance_along(m, s) < distance; });
}

}  // namespace

Contour::Contour(Loop points) : points_(std::move(points)) {
  double s = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    arc_.push_back(s);
    s += (points_[(i + 1) % points_.size()] - points_[i]).norm();
  }
  arc_.push_back(s);
}

double Contour::wrapped(double s) const {
  s = std::fmod(s, length());
  return s < 0 ? s + length() : s;
}

double Contour::distance_along(double s, double t) const {
  const double d = std::abs(wrapped(s) - wrapped(t));
  return std::min(d, length() - d);
}

std::size_t Contour::nearest_point(double s) const {
  s = wrapped(s);
  const std::size_t after = std::lower_bound(arc_.begin(), arc_.end(), s) - arc_.begin();
  if (after == 0) return 0;
  const bool is_after = arc_[after] - s < s - arc_[after - 1];
  return (is_after ? after : after - 1) % points_.size();
}

Vector2d Contour::at(double s) const {
  s = wrapped(s);
  const std::size_t i = std::min<std::size_t>(
      std::upper_bound(arc_.begin(), arc_.end(), s) - arc_.begin() - 1, points_.size() - 1);
  const double size = arc_[i + 1] - arc_[i];
  const double t = size > 0 ? (s - arc_[i]) / size : 0;
  return points_[i] + t * (points_[(i + 1) % points_.size()] - points_[i]);
}

Vector2d Contour::smooth_at(double s) const {
  constexpr int kSteps = 6;
  double window = std::min(kSmoothing, length() / 16);
  if (!marks_.empty()) {
    const auto after = std::lower_bound(marks_.begin(), marks_.end(), wrapped(s));
    const double next = after == marks_.end() ? marks_.front() : *after;
    const double before = after == marks_.begin() ? marks_.back() : *std::prev(after);
    window = std::min({window, distance_along(before, s), distance_along(next, s)});
  }
  Vector2d sum = Vector2d::Zero();
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double weight = std::abs(k) == kSteps ? 0.5 : 1;
    sum += weight * at(s + window * k / kSteps);
  }
  return sum / (2 * kSteps);
}

double Contour::turning(double s, double arm) const {
  const Vector2d p = at(s), in = p - at(s - arm), out = at(s + arm) - p;
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

Vector2d Contour::direction(double s, double arm) const {
  const Vector2d chord = at(s + arm) - at(s - arm);
  const double length = chord.norm();
  return length > 0 ? Vector2d(chord / length) : Vector2d(1, 0);
}

std::vector<double> Contour::frame_ends(const Spacing& spacing, double width, double height) const {
  const std::size_t n = points_.size();
  // The side on which the segment from point i lies: 1 to 4, or 0.
  const auto side = [&](std::size_t i) {
    const Vector2d &a = points_[i], &b = points_[(i + 1) % n];
    if (a.x() == b.x() && a.x() == 0) return 1;
    if (a.x() == b.x() && a.x() == width) return 2;
    if (a.y() == b.y() && a.y() == 0) return 3;
    return a.y() == b.y() && a.y() == height ? 4 : 0;
  };
  std::vector<std::size_t> changes;
  for (std::size_t i = 0; i < n; ++i) {
    if (side(i) != side((i + n - 1) % n)) changes.push_back(i);
  }
  std::vector<double> ends;
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const std::size_t from = changes[c], to = changes[(c + 1) % changes.size()];
    if (side(from) == 0) continue;
    const double run = changes.size() == 1 ? length() : wrapped(arc_[to] - arc_[from]);
    if (run < std::max(kLeastFrameRun, kMeshArm * spacing(points_[from]))) continue;
    ends.push_back(arc_[from]);
    ends.push_back(arc_[to]);
  }
  remove_duplicates(ends);
  return ends;
}

std::vector<double> Contour::corners(const Spacing& spacing) const {
  struct Corner {
    double s, turn;
  };
  std::vector<Corner> found;
  if (length() < kLeastCornerLoop) return {};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double s = arc_[i];
    const double turn = turning(s, kLongArm);
    if (turn < kLongTurn || turning(s, kShortArm) < kShortTurn) continue;
    const double arm = std::min(kMeshArm * spacing(points_[i]), length() / 8);
    if (arm > kLongArm && turning(s, arm) < kMeshTurn) continue;
    found.push_back({s, turn + turning(s, kShortArm)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Corner& a, const Corner& b) { return a.turn > b.turn; });
  std::vector<double> places;
  for (const Corner& c : found) {
    if (!is_marked(places, *this, c.s, kLongArm)) places.push_back(c.s);
  }
  return places;
}

void Contour::find_marks(const Spacing& spacing, double width, double height) {
  marks_ = frame_ends(spacing, width, height);
  for (const double s : corners(spacing)) {
    if (!is_marked(marks_, *this, s, kMarkDistance)) marks_.push_back(s);
  }
  std::sort(marks_.begin(), marks_.end());
}

std::vector<CurveSegment> segments_of(const std::vector<Contour>& contours) {
  std::vector<CurveSegment> segments;
  for (int c = 0; c < static_cast<int>(contours.size()); ++c) {
    const Loop& points = contours[c].points();
    for (std::size_t i = 0; i < points.size(); ++i) {
      segments.push_back({c, points[i], points[(i + 1) % points.size()], contours[c].arc_of(i)});
    }
  }
  return segments;
}

}  // namespace quadrille
