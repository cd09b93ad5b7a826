#include "quadrille/planar_loops.h"

#include <algorithm>
#include <cmath>

#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool within_box(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return (p.array() >= a.array().min(b.array())).all() &&
         (p.array() <= a.array().max(b.array())).all();
}

bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double to_c = turn(a, b, c), to_d = turn(a, b, d);
  const double to_a = turn(c, d, a), to_b = turn(c, d, b);
  if (((to_c > 0 && to_d < 0) || (to_c < 0 && to_d > 0)) &&
      ((to_a > 0 && to_b < 0) || (to_a < 0 && to_b > 0))) {
    return true;
  }
  return (to_c == 0 && within_box(a, b, c)) || (to_d == 0 && within_box(a, b, d)) ||
         (to_a == 0 && within_box(c, d, a)) || (to_b == 0 && within_box(c, d, b));
}

/// True when the sides before and after the corner b run over each other.
bool is_spike(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return turn(a, b, c) == 0 && (a - b).dot(c - b) > 0;
}

/// The sides sorted into the cells of a uniform grid that their boxes touch.
class SideGrid {
 public:
  explicit SideGrid(const std::vector<Loop>& loops) {
    Vector2d high = Vector2d::Constant(-INFINITY);
    low_ = Vector2d::Constant(INFINITY);
    double length = 0;
    std::size_t count = 0;
    for (const Loop& loop : loops) {
      for (const Vector2d& p : loop) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
      length += perimeter(loop);
      count += loop.size();
    }
    if (count == 0) return;
    const Vector2d size = high - low_;
    cell_ = std::max(
        {length / count, std::sqrt(size.prod() / (4.0 * count)), size.maxCoeff() / 65536, 1e-300});
    columns_ = static_cast<int>(size.x() / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) *
                  (static_cast<std::size_t>(size.y() / cell_) + 1));
    for (int l = 0; l < static_cast<int>(loops.size()); ++l) {
      const int n = static_cast<int>(loops[l].size());
      for (int i = 0; i < n; ++i) add({l, i}, loops[l][i], loops[l][(i + 1) % n]);
    }
  }

  const std::vector<std::vector<LoopSide>>& cells() const { return cells_; }

 private:
  void add(const LoopSide& side, const Vector2d& a, const Vector2d& b) {
    const Vector2d first = (a.cwiseMin(b) - low_) / cell_, last = (a.cwiseMax(b) - low_) / cell_;
    for (int y = static_cast<int>(first.y()); y <= static_cast<int>(last.y()); ++y) {
      for (int x = static_cast<int>(first.x()); x <= static_cast<int>(last.x()); ++x) {
        cells_[static_cast<std::size_t>(y) * columns_ + x].push_back(side);
      }
    }
  }

  Vector2d low_;
  double cell_ = 1;
  int columns_ = 0;
  std::vector<std::vector<LoopSide>> cells_;
};

bool conflict(const std::vector<Loop>& loops, const LoopSide& s, const LoopSide& t) {
  const Loop &u = loops[s.loop], &v = loops[t.loop];
  const int n = static_cast<int>(u.size()), m = static_cast<int>(v.size());
  const Vector2d &a = u[s.index], &b = u[(s.index + 1) % n];
  const Vector2d &c = v[t.index], &d = v[(t.index + 1) % m];
  if (s.loop == t.loop) {
    const bool follows = (s.index + 1) % n == t.index, precedes = (t.index + 1) % n == s.index;
    if (follows && precedes) return true;
    if (follows) return is_spike(a, b, d);
    if (precedes) return is_spike(c, d, b);
  }
  return meet(a, b, c, d);
}

}  // namespace

double signed_area(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    // Relative to the first point, so that far-away loops lose no digits.
    const Vector2d p = loop[i] - loop[0], q = loop[(i + 1) % loop.size()] - loop[0];
    sum += 0.5 * (p.x() * q.y() - q.x() * p.y());
  }
  return sum;
}

double perimeter(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  return sum;
}

int winding_number(const Loop& loop, const Vector2d& p) {
  int number = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2d &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (a.y() <= p.y() && b.y() > p.y() && turn(a, b, p) > 0) ++number;
    if (a.y() > p.y() && b.y() <= p.y() && turn(a, b, p) < 0) --number;
  }
  return number;
}

std::vector<std::array<LoopSide, 2>> conflicts(const std::vector<Loop>& loops) {
  std::vector<std::array<LoopSide, 2>> found;
  for (int l = 0; l < static_cast<int>(loops.size()); ++l) {
    if (loops[l].size() < 3) found.push_back({LoopSide{l, 0}, LoopSide{l, 0}});
  }
  if (!found.empty()) return found;
  const SideGrid grid(loops);
  for (const auto& cell : grid.cells()) {
    for (std::size_t i = 0; i < cell.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (conflict(loops, cell[j], cell[i])) {
          found.push_back({std::min(cell[i], cell[j]), std::max(cell[i], cell[j])});
        }
      }
    }
  }
  remove_duplicates(found);
  return found;
}

bool is_nested(const std::vector<Loop>& loops) {
  struct Box {
    Eigen::Array2d low = Eigen::Array2d::Constant(INFINITY), high = -low;
  };
  std::vector<Box> boxes(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (const Vector2d& p : loops[l]) {
      boxes[l].low = boxes[l].low.min(p.array());
      boxes[l].high = boxes[l].high.max(p.array());
    }
  }
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const double area = signed_area(loops[l]);
    if (area == 0) return false;
    const Vector2d& p = loops[l][0];
    int around = 0;
    for (std::size_t m = 0; m < loops.size(); ++m) {
      const bool reaches = (p.array() >= boxes[m].low).all() && (p.array() <= boxes[m].high).all();
      if (m != l && reaches) around += winding_number(loops[m], p);
    }
    if (around != (area > 0 ? 0 : 1)) return false;
  }
  return true;
}

}  // namespace quadrille
