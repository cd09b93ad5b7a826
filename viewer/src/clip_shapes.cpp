#include "clip_shapes.h"

#include <algorithm>
#include <set>

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

class Clipper {
 public:
  Clipper(const SceneShapes& shapes, const Eigen::Array2d& scale, const Eigen::Array2d& origin,
          const Eigen::AlignedBox2d& box)
      : shapes_(shapes), box_(box) {
    placed_.reserve(shapes.points.size());
    for (const Vector2d& p : shapes.points)
      placed_.push_back((p.array() * scale + origin).matrix());
  }

  void add_points() {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (box_.contains(placed_[i])) clipped_.points.emplace_back(static_cast<int>(i), placed_[i]);
    }
  }

  void add_polyline(int cell) {
    run_.clear();
    for (int k = shapes_.cell_begin[cell]; k + 1 < shapes_.cell_begin[cell + 1]; ++k) {
      add_segment(cell, shapes_.cell_points[k], shapes_.cell_points[k + 1]);
    }
    end_run(cell);
  }

  void add_outline(int cell) {
    const int begin = shapes_.cell_begin[cell], end = shapes_.cell_begin[cell + 1];
    for (int k = begin; k < end; ++k) {
      const int a = shapes_.cell_points[k], b = shapes_.cell_points[k + 1 < end ? k + 1 : begin];
      if (!drawn_.emplace(std::minmax(a, b)).second) continue;
      add_segment(cell, a, b);
      end_run(cell);
    }
  }

  WindowShapes finish() { return std::move(clipped_); }

 private:
  /// Appends what is inside to the run; where the polyline leaves the box, the run ends.
  void add_segment(int cell, int from, int to) {
    Vector2d a = placed_[from], b = placed_[to];
    if (!clip_segment(box_, a, b)) return end_run(cell);
    if (run_.empty() || run_.back() != a) {
      end_run(cell);
      run_.push_back(a);
    }
    run_.push_back(b);
    if (b != placed_[to]) end_run(cell);
  }

  void end_run(int cell) {
    if (run_.size() >= 2) clipped_.lines.push_back({cell, run_});
    run_.clear();
  }

  const SceneShapes& shapes_;
  const Eigen::AlignedBox2d box_;
  std::vector<Vector2d> placed_, run_;
  std::set<std::pair<int, int>> drawn_;
  WindowShapes clipped_;
};

}  // namespace

bool clip_segment(const Eigen::AlignedBox2d& box, Vector2d& a, Vector2d& b) {
  const Vector2d start = a, d = b - a;
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = box.min()[axis] - start[axis], high = box.max()[axis] - start[axis];
    if (d[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const auto [first, last] = std::minmax({low / d[axis], high / d[axis]});
    enter = std::max(enter, first);
    leave = std::min(leave, last);
  }
  if (enter > leave) return false;
  if (leave < 1) b = start + leave * d;
  if (enter > 0) a = start + enter * d;
  return true;
}

WindowShapes clip_shapes(const SceneShapes& shapes, const Eigen::Array2d& scale,
                         const Eigen::Array2d& origin, const Eigen::AlignedBox2d& box) {
  Clipper clipper(shapes, scale, origin, box);
  switch (shapes.cell) {
    case SceneShapes::Cell::point:
      clipper.add_points();
      break;
    case SceneShapes::Cell::line:
      for (int c = 0; c < shapes.cell_count(); ++c) clipper.add_polyline(c);
      break;
    case SceneShapes::Cell::polygon:
      for (int c = 0; c < shapes.cell_count(); ++c) clipper.add_outline(c);
      break;
  }
  return clipper.finish();
}

}  // namespace quadrille::viewer
