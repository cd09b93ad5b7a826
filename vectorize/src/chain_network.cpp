#include "chain_network.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chain_curve.h"

namespace quadrille {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFitReach = 5;               // pixels of a chain's end that tell its direction
constexpr double kNodePull = 0.05;            // of a junction toward where the cells have it
constexpr double kFarthestNode = 2;           // pixels from there
constexpr double kCornerTurn = 45 * kDegree;  // of chords over
constexpr double kCornerArm = 3;              // pixels on either side
constexpr double kCornerGap = 1.5;            // pixels beside a corner that blur rounds

/// A straight line through some points.
struct Line {
  Vector2d point, direction;
};

/// Fits the points at a chain's end whose distance from it is between `skip` and `skip` +
/// kFitReach; the direction runs toward the end.
Line line_at_end(const std::vector<Vector2d>& points, bool is_back, double skip) {
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[is_back ? n - 1 - i : i]; };
  std::vector<Vector2d> used;
  double s = 0;
  for (int i = 0; i < n && s <= skip + kFitReach; ++i) {
    if (i > 0) s += (at(i) - at(i - 1)).norm();
    if (s >= skip) used.push_back(at(i));
  }
  if (used.size() < 2) used = {at(0), at(std::min(n - 1, 1))};
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : used) mean += p / static_cast<double>(used.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Vector2d& p : used) {
    const Vector2d d = p - mean;
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  Vector2d direction(std::cos(angle), std::sin(angle));
  if (direction.dot(used.front() - used.back()) < 0) direction = -direction;
  return {mean, direction};
}

/// The point nearest to the lines in the least-squares sense, pulled a little toward `start`.
Vector2d meeting_point(const std::vector<Line>& lines, const Vector2d& start) {
  Matrix2d a = kNodePull * Matrix2d::Identity();
  Vector2d b = kNodePull * start;
  for (const Line& line : lines) {
    const Matrix2d across = Matrix2d::Identity() - line.direction * line.direction.transpose();
    a += across;
    b += across * line.point;
  }
  const Vector2d away = a.inverse() * b - start;
  return start + away * std::min(1.0, kFarthestNode / std::max(away.norm(), 1e-12));
}

double turn(const Vector2d& in, const Vector2d& out) {
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

/// Indices of the points where the line turns sharply, ascending.
std::vector<int> corners(const std::vector<Vector2d>& p) {
  const int n = static_cast<int>(p.size());
  const std::vector<double> s = arc_lengths(p);
  const auto index_at = [&](double place) {
    return static_cast<int>(std::lower_bound(s.begin(), s.end(), place) - s.begin());
  };
  std::vector<double> turns(n, 0);
  for (int i = 0; i < n; ++i) {
    if (s[i] < kCornerArm || s.back() - s[i] < kCornerArm) continue;
    const int a = index_at(s[i] - kCornerArm), b = std::min(n - 1, index_at(s[i] + kCornerArm));
    turns[i] = turn(p[i] - p[a], p[b] - p[i]);
  }
  std::vector<int> found;
  for (int i = 0; i < n; ++i) {
    if (turns[i] < kCornerTurn) continue;
    bool is_peak = true;
    for (int k = index_at(s[i] - kCornerArm); k < n && s[k] <= s[i] + kCornerArm && is_peak; ++k) {
      is_peak = k == i || turns[k] < turns[i] || (turns[k] == turns[i] && k > i);
    }
    if (is_peak) found.push_back(i);
  }
  return found;
}

/// Means over neighbours, twice with opposite sign so that bends do not shrink (Taubin, A signal
/// processing approach to fair surface design, 1995). The ends stay.
std::vector<Vector2d> smoothed(std::vector<Vector2d> points) {
  const auto blur = [](const std::vector<Vector2d>& p) {
    std::vector<Vector2d> q = p;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      q[i] = 0.25 * p[i - 1] + 0.5 * p[i] + 0.25 * p[i + 1];
    }
    return q;
  };
  for (int round = 0; round < 2; ++round) {
    const std::vector<Vector2d> once = blur(points), twice = blur(once);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = 2 * once[i] - twice[i];
  }
  return points;
}

/// Lets a closed line start where it turns least: at a start in a corner, such as the topmost one
/// of a tilted rectangle, that corner would be missed.
void start_where_straightest(std::vector<Vector2d>& points) {
  constexpr int kArm = 4;  // points, together as long as a corner's arm
  const int n = static_cast<int>(points.size());
  if (n < 2 * kArm) return;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const Vector2d before = points[(i + n - kArm) % n], after = points[(i + kArm) % n];
    const double here = turn(points[i] - before, after - points[i]);
    if (here < least) least = here, best = i;
  }
  std::rotate(points.begin(), points.begin() + best, points.end());
}

class NetworkBuilder {
 public:
  NetworkBuilder(const std::vector<TracedChain>& traced, const std::vector<Vector2d>& places,
                 double width, double height)
      : traced_(traced), places_(places), size_(width, height), ends_(places.size()) {
    for (int c = 0; c < static_cast<int>(traced_.size()); ++c) {
      ends_[traced_[c].from].push_back({c, false});
      ends_[traced_[c].to].push_back({c, true});
    }
    for (TracedChain& chain : traced_) {
      const bool is_lone_loop = chain.from == chain.to && ends_[chain.from].size() == 2;
      if (is_lone_loop) start_where_straightest(chain.points);
    }
  }

  ChainNetwork build() {
    number_.assign(places_.size(), -1);
    for (int n = 0; n < static_cast<int>(places_.size()); ++n) {
      if (!ends_[n].empty()) number_[n] = add_node(node_place(n));
    }
    for (const TracedChain& chain : traced_) divide(chain);
    return std::move(result_);
  }

 private:
  struct End {
    int chain;
    bool is_back;
  };
  std::vector<TracedChain> traced_;
  const std::vector<Vector2d>& places_;
  Vector2d size_;
  std::vector<std::vector<End>> ends_;  // per node
  std::vector<int> number_;             // of the nodes in the result
  ChainNetwork result_;

  int add_node(const Vector2d& p) {
    result_.nodes.push_back(p.cwiseMax(0.0).cwiseMin(size_));
    return static_cast<int>(result_.nodes.size()) - 1;
  }

  Vector2d node_place(int n) const {
    const std::vector<End>& ends = ends_[n];
    if (ends.size() == 2 && ends[0].chain == ends[1].chain) {
      // A loop may start anywhere.
      const std::vector<Vector2d>& p = traced_[ends[0].chain].points;
      return 0.5 * (p.front() + p.back());
    }
    std::vector<Line> lines;
    for (const End& end : ends) {
      lines.push_back(line_at_end(traced_[end.chain].points, end.is_back, 0));
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (places_[n][axis] <= 0 || places_[n][axis] >= size_[axis]) {
        return border_point(lines.front(), places_[n], axis);
      }
    }
    return meeting_point(lines, places_[n]);
  }

  /// Where the line meets the side on which the node lies.
  static Vector2d border_point(const Line& line, const Vector2d& node, int axis) {
    constexpr double kOblique = 0.1;  // a line nearly along the side meets it anywhere
    if (std::abs(line.direction[axis]) < kOblique) return node;
    const double t = (node[axis] - line.point[axis]) / line.direction[axis];
    const Vector2d place = line.point + t * line.direction;
    return (place - node).norm() > kFarthestNode ? node : place;
  }

  /// Adds the pieces of a chain between its corners.
  void divide(const TracedChain& chain) {
    const std::vector<Vector2d>& p = chain.points;
    int from = number_[chain.from];
    auto begin = p.begin();
    for (const int corner : corners(p)) {
      const auto at = p.begin() + corner;
      const Line in = line_at_end({begin, at + 1}, true, kCornerGap);
      const Line out = line_at_end({at, p.end()}, false, kCornerGap);
      const int node = add_node(meeting_point({in, out}, p[corner]));
      add(chain, {begin, at}, from, node);
      from = node;
      begin = at + 1;
    }
    add(chain, {begin, p.end()}, from, number_[chain.to]);
  }

  /// Adds a chain between two nodes of the result; points beside the nodes give way to them.
  void add(const TracedChain& chain, std::vector<Vector2d> points, int from, int to) {
    const Vector2d a = result_.nodes[from], b = result_.nodes[to];
    std::erase_if(points, [&](const Vector2d& p) {
      return (p - a).norm() < kCornerGap || (p - b).norm() < kCornerGap;
    });
    if (points.empty() && from == to) return;
    points.insert(points.begin(), a);
    points.push_back(b);
    points = smoothed(std::move(points));
    const double length = arc_lengths(points).back();
    result_.chains.push_back(
        {std::move(points), from, to, length, chain.contrast, chain.sharpness, chain.contrast});
  }
};

}  // namespace

ChainNetwork chain_network(const std::vector<TracedChain>& traced,
                           const std::vector<Vector2d>& places, double width, double height) {
  return NetworkBuilder(traced, places, width, height).build();
}

}  // namespace quadrille
