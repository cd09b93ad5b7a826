#include "inkscape_outline.h"

#include <algorithm>

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kSamePoint = 1e-3;  // pixels

/// A side on the border of a grid, and how far its ends are moved into the quad beyond it.
struct BorderSide {
  int halfedge;
  PlaneCurve curve;
  bool is_hidden = false;
  Vector2d start_by = Vector2d::Zero(), end_by = Vector2d::Zero();

  Vector2d start() const { return curve[0] + start_by; }
  Vector2d end() const { return curve[3] + end_by; }
};

class OutlineOfGrid {
 public:
  OutlineOfGrid(const Layer& layer, const QuadGrid& grid, const PlacedGrid& placed, double bleed,
                const std::function<bool(int)>& goes_under)
      : layer_(layer), grid_(grid), placed_(placed), bleed_(bleed), goes_under_(goes_under) {
    const int right = grid.columns - 1, bottom = grid.rows - 1;
    for (int i = 0; i <= right; ++i) add(i, 0, 0);
    for (int j = 0; j <= bottom; ++j) add(right, j, 1);
    for (int i = right; i >= 0; --i) add(i, bottom, 2);
    for (int j = bottom; j >= 0; --j) add(0, j, 3);
  }

  SvgOutline outline() {
    outline_.start = sides_.front().start();
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      add_curve(sides_[i]);
      join(sides_[i], sides_[(i + 1) % sides_.size()]);
    }
    return std::move(outline_);
  }

 private:
  void add(int column, int row, int k) {
    const int top = grid_.top(column, row);
    const int h = (top & ~3) | ((top + k) & 3);
    BorderSide side{h, side_curve(placed_.position(column, row), k)};
    if (goes_under_(h)) {
      const int twin = mesh().twin(h);
      side.is_hidden = true;
      side.start_by = along(QuadMesh::next(twin), 0);
      side.end_by = -along(QuadMesh::prev(twin), 1);
    }
    sides_.push_back(side);
  }

  /// The bleed along a half-edge at its origin (at = 0) or tip, at most half of it.
  Vector2d along(int h, int at) const {
    const Vector2d tangent = layer_.transform.linear() * tangent_along(layer_.patches, h, at);
    return tangent.normalized() * std::min(bleed_, 0.5 * tangent.norm());
  }

  /// Goes on to the next side, around the vertex in between where colours allow that.
  void join(const BorderSide& side, const BorderSide& next) {
    if ((side.end() - next.start()).norm() < kSamePoint) return;
    if (side.is_hidden && next.is_hidden) {
      const Vector2d& vertex = side.curve[3];
      const bool is_corner =
          side.end_by.dot(next.start_by) < 0.7 * side.end_by.norm() * next.start_by.norm();
      if (!is_smooth_around(side.halfedge)) {
        add_line(vertex);
      } else if (is_corner) {
        add_line(vertex + side.end_by + next.start_by);
      }
    }
    add_line(next.start());
  }

  /// True when colours are continuous around the tip of h, so that no pixel there is spoiled.
  bool is_smooth_around(int h) const {
    const int vertex = mesh().tip(h);
    if (mesh().is_border_vertex(vertex)) return false;
    const auto fan = mesh().fan(vertex);
    return std::ranges::none_of(fan, [&](int f) { return mesh().is_tear(mesh().edge(f)); });
  }

  void add_curve(const BorderSide& side) {
    constexpr double kFlatness = 0.005;
    const PlaneCurve& p = side.curve;
    const auto moved = [&](int i) -> Vector2d {
      return p[i] + side.start_by * ((3 - i) / 3.0) + side.end_by * (i / 3.0);
    };
    const bool is_line = chord_distance(p) < kFlatness;
    outline_.pieces.push_back({is_line, moved(1), moved(2), moved(3)});
  }
  const QuadMesh& mesh() const { return layer_.patches.mesh; }
  void add_line(const Vector2d& to) { outline_.pieces.push_back({true, to, to, to}); }

  const Layer& layer_;
  const QuadGrid& grid_;
  const PlacedGrid& placed_;
  double bleed_;
  const std::function<bool(int)>& goes_under_;
  std::vector<BorderSide> sides_;
  SvgOutline outline_;
};

}  // namespace

SvgOutline grid_outline(const Layer& layer, const QuadGrid& grid, const PlacedGrid& placed,
                        double bleed, const std::function<bool(int)>& goes_under) {
  return OutlineOfGrid(layer, grid, placed, bleed, goes_under).outline();
}

}  // namespace quadrille
