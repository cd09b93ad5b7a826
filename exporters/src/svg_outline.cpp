#include "svg_outline.h"

#include <algorithm>
#include <cmath>

#include "patch_sides.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Geometry = BicubicHermite<Vector2d>;

/// Farthest that a straight line may be from the curve it stands for, in pixels: along the outline
/// of the mesh and tears, along seams of smooth colour, and where later cells hide it.
constexpr double kExactFlatness = 0.01, kSeamFlatness = 0.25, kHiddenFlatness = 0.25;
/// How far cells go on beyond a clip, in bleeds: all over the pixels that the clip halves.
constexpr double kClippedBleed = 1.5;
/// How far a seam may be from its chord where corners alone are moved for the bleed, in bleeds, and
/// where no bleed goes across it, in pixels; and the least sine of the angle between a side and the
/// next along which a corner moves.
constexpr double kPlainFlatness = 0.6, kPlainSeamFlatness = 0.6, kLeastSlope = 0.5;
/// Points of an outline nearer than this to the line past them are left out, in pixels.
constexpr double kStraightness = 0.06;

Vector2d at(const Geometry& g, const Vector2d& uv) { return g.at(uv.x(), uv.y()); }

/// The number of chords, equal in the parameter, that stay that near to the curve; at most 8.
int chords_along(const PlaneCurve& curve, double flatness) {
  constexpr int kMost = 8;
  for (int parts = 1; parts < kMost; ++parts) {
    bool flat = true;
    for (int i = 0; i < parts && flat; ++i) {
      flat = chord_distance(sub_curve(curve, double(i) / parts, double(i + 1) / parts)) <= flatness;
    }
    if (flat) return parts;
  }
  return kMost;
}

class OutlineBuilder {
 public:
  OutlineBuilder(const SvgLayer& layer, int quad, const ParameterBox& cell, double bleed)
      : layer_(layer),
        quad_(quad),
        cell_(cell),
        bleed_(bleed),
        geometry_(layer.geometry(quad)),
        bezier_(to_bezier(geometry_)) {
    const Vector2d du = geometry_.derivative_u(0.5, 0.5), dv = geometry_.derivative_v(0.5, 0.5);
    orientation_ = du.x() * dv.y() < du.y() * dv.x() ? -1 : 1;
    for (int k = 0; k < 4; ++k) {
      later_[k] = layer_.is_painted_later(4 * quad + k);
      clipped_[k] = layer_.is_clipped(4 * quad + k);
    }
    grow_within_patch();
  }

  SvgOutline build() {
    const BicubicBezier<Vector2d> part = sub_patch(bezier_, box_);
    if (is_plain(part)) return build_plain(part);
    for (int k = 0; k < 4; ++k) outline_.is_exact |= !is_smooth_seam(k) && !clipped_[k];
    for (int k = 0; k < 4; ++k) {
      add_corner(k);
      if (has_flange(k)) {
        add_flange(k);
      } else {
        add_side(k, side_curve(part, k));
      }
    }
    outline_.pieces.erase(outline_.pieces.begin());
    return std::move(outline_);
  }

 private:
  /// True when moving the corners is bleed enough: the sides with bleed are about straight, and
  /// neither the cell nor the patches under which it bleeds touch the outline or a tear, across
  /// which paint must not go.
  bool is_plain(const BicubicBezier<Vector2d>& part) const {
    for (int k = 0; k < 4; ++k) {
      if (!is_smooth_seam(k)) return false;
      if (has_flange(k)) {
        if (chord_distance(side_curve(part, k)) > kPlainFlatness * bleed_) return false;
        if (!has_smooth_sides(QuadMesh::quad_of(layer_.mesh().twin(4 * quad_ + k)))) return false;
      }
      const int before = (k + 3) & 3;
      const bool at_vertex = on_border(before) && on_border(k);
      if (at_vertex && (has_flange(before) || has_flange(k)) && !is_plain_vertex(4 * quad_ + k)) {
        return false;
      }
    }
    return true;
  }

  bool has_smooth_sides(int quad) const {
    for (int h = 4 * quad; h < 4 * quad + 4; ++h) {
      if (!is_smooth(h)) return false;
    }
    return true;
  }

  /// True when all around the origin of half-edge h colours are smooth.
  bool is_plain_vertex(int h) const {
    const QuadMesh& mesh = layer_.mesh();
    for (const int around : mesh.fan(mesh.origin(h))) {
      if (!is_smooth(around) ||
          layer_.opacity(QuadMesh::quad_of(around)) != layer_.opacity(quad_)) {
        return false;
      }
    }
    return true;
  }

  /// True when all other patches around the origin of half-edge h are painted later.
  bool all_later_around(int h) const {
    const auto fan = layer_.mesh().fan(layer_.mesh().origin(h));
    return std::all_of(fan.begin(), fan.end(), [&](int around) {
      const int quad = QuadMesh::quad_of(around);
      return quad == quad_ || layer_.is_painted_later(quad_, quad);
    });
  }

  /// The cell with its corners moved outward along its sides, on across those with bleed.
  SvgOutline build_plain(const BicubicBezier<Vector2d>& part) {
    std::array<PlaneCurve, 4> sides;
    for (int k = 0; k < 4; ++k) sides[k] = side_curve(part, k);
    for (int k = 0; k < 4; ++k) {
      const int before = (k + 3) & 3;
      const Vector2d corner = sides[k][0];
      Vector2d end = corner, start = corner;
      if (has_flange(before)) end += across(before, sides[k][0] - sides[k][3], sides[before]);
      if (has_flange(k)) start += across(k, sides[before][3] - sides[before][0], sides[k]);
      if (has_flange(before) && has_flange(k) && !all_later_around(4 * quad_ + k)) {
        add_point(end);
        add_point(corner);
        add_point(start);
      } else {
        add_point(end + start - corner);
      }
      if (!has_flange(k) && !is_hidden(k)) add_curve(sides[k], kPlainSeamFlatness);
    }
    outline_.pieces.erase(outline_.pieces.begin());
    return std::move(outline_);
  }

  /// The step in the given direction that leads across side k as far as its bleed goes.
  Vector2d across(int k, const Vector2d& direction, const PlaneCurve& side) const {
    const Vector2d along = (side[3] - side[0]).normalized(), step = direction.normalized();
    const auto [first, last] = side_range(k);
    double depth = bleed_;  // less where the later patch is thin
    for (const double s : {first, 0.5 * (first + last), last}) {
      const Vector2d seam = at(geometry_, on_side(k, s));
      depth = std::min(depth, (beyond(k, s) - seam).norm());
    }
    const double outward = step.x() * along.y() - step.y() * along.x();
    if (!(outward > kLeastSlope)) return depth * Vector2d(along.y(), -along.x());
    return depth / outward * step;
  }

  /// Cells of one patch are painted from low to high parameters.
  void grow_within_patch() {
    box_ = cell_;
    const Vector2d middle(0.5 * (cell_.u0 + cell_.u1), 0.5 * (cell_.v0 + cell_.v1));
    const double step_u = parameter_step(geometry_, {cell_.u1, middle.y()}, true, bleed_);
    const double step_v = parameter_step(geometry_, {middle.x(), cell_.v1}, false, bleed_);
    if (cell_.u1 < 1) box_.u1 = std::min(1.0, cell_.u1 + step_u);
    if (cell_.v1 < 1) box_.v1 = std::min(1.0, cell_.v1 + step_v);
  }

  bool on_border(int k) const {
    switch (k) {
      case 0:
        return box_.v0 == 0;
      case 1:
        return box_.u1 == 1;
      case 2:
        return box_.v1 == 1;
      default:
        return box_.u0 == 0;
    }
  }
  /// Painted beyond side k, where something hides or clips it.
  bool has_flange(int k) const { return on_border(k) && (later_[k] || clipped_[k]); }
  bool is_hidden(int k) const {
    return !on_border(k) && ((k == 1 && box_.u1 > cell_.u1) || (k == 2 && box_.v1 > cell_.v1));
  }
  bool is_smooth_seam(int k) const { return !on_border(k) || is_smooth(4 * quad_ + k); }
  bool is_smooth(int h) const {
    return layer_.mesh().twin(h) >= 0 && !layer_.mesh().is_tear(layer_.mesh().edge(h));
  }

  /// Range of side k's own parameter, which runs from corner k to corner k + 1.
  std::array<double, 2> side_range(int k) const {
    switch (k) {
      case 0:
        return {box_.u0, box_.u1};
      case 1:
        return {box_.v0, box_.v1};
      case 2:
        return {1 - box_.u1, 1 - box_.u0};
      default:
        return {1 - box_.v1, 1 - box_.v0};
    }
  }

  void add_side(int k, const PlaneCurve& curve) {
    const double flatness = is_hidden(k)        ? kHiddenFlatness
                            : is_smooth_seam(k) ? kSeamFlatness
                                                : kExactFlatness;
    add_curve(curve, flatness);
  }

  void add_curve(const PlaneCurve& curve, double flatness) {
    add_point(curve[0]);
    if (chord_distance(curve) <= flatness) {
      add_point(curve[3]);
    } else {
      outline_.pieces.push_back({false, curve[1], curve[2], curve[3]});
    }
  }

  /// The far side of a strip of the later patch beyond side k, without its ends.
  void add_flange(int k) {
    const auto [first, last] = side_range(k);
    const PlaneCurve seam = sub_curve(side_curve(bezier_, k), first, last);
    const int parts = chords_along(seam, kHiddenFlatness);
    for (int i = 1; i < parts; ++i) add_point(beyond(k, first + (last - first) * i / parts));
  }

  /// The point `bleed` beyond side k at s, in the patch on its other side, or beyond a clip.
  Vector2d beyond(int k, double s) const {
    const int twin = layer_.mesh().twin(4 * quad_ + k);
    if (twin < 0) return at(geometry_, on_side(k, s)) + outward(k, s);
    return inside(layer_.geometry(QuadMesh::quad_of(twin)), QuadMesh::corner_of(twin), 1 - s,
                  clipped_[k] ? kClippedBleed * bleed_ : bleed_);
  }

  /// The bleed beyond the border of the mesh.
  Vector2d outward(int k, double s) const {
    const Vector2d uv = on_side(k, s);
    Vector2d along = k % 2 == 0 ? geometry_.derivative_u(uv.x(), uv.y())
                                : geometry_.derivative_v(uv.x(), uv.y());
    if (k >= 2) along = -along;
    return orientation_ * kClippedBleed * bleed_ * Vector2d(along.y(), -along.x()).normalized();
  }

  /// True when all that is painted around the origin of half-edge h is of the part of this patch:
  /// a corner may then reach anywhere there.
  bool has_one_part_around(int h) const {
    const auto fan = layer_.mesh().fan(layer_.mesh().origin(h));
    return std::all_of(fan.begin(), fan.end(), [&](int around) {
      const int quad = QuadMesh::quad_of(around);
      return layer_.opacity(quad) == PatchOpacity::transparent ||
             (layer_.is_opaque(quad) && layer_.part(quad) == layer_.part(quad_));
    });
  }

  /// The same as add_corner() where a clip ends one of the sides or both.
  void add_clipped_corner(int k) {
    const int before = (k + 3) & 3, h = 4 * quad_ + k;
    const Vector2d corner = geometry_.value[k];
    const Vector2d end = has_flange(before) ? beyond(before, 1) : corner;
    const Vector2d start = has_flange(k) ? beyond(k, 0) : corner;
    if (later_[before]) walk_around(h, true);
    if (clipped_[before]) add_point(end);
    if (has_flange(before) && has_flange(k) && has_one_part_around(h)) {
      add_point(end + start - corner);
    } else {
      add_point(corner);
    }
    if (clipped_[k]) add_point(start);
    if (later_[k]) walk_around(h, false);
  }

  /// Joins side k - 1 to side k where one of them has a flange.
  void add_corner(int k) {
    const int before = (k + 3) & 3;
    const bool from_flange = has_flange(before), to_flange = has_flange(k);
    if (!from_flange && !to_flange) return;
    if (!on_border(before) || !on_border(k)) {  // inside a side of the patch
      add_point(from_flange ? beyond(before, side_range(before)[1]) : beyond(k, side_range(k)[0]));
      return;
    }
    if (clipped_[before] || clipped_[k]) return add_clipped_corner(k);
    const int h = 4 * quad_ + k;
    if (from_flange && walk_around(h, true)) return;
    add_point(geometry_.value[k]);
    if (to_flange) walk_around(h, false);
  }

  /// Adds the end of a flange and goes on around the origin of half-edge h of this patch as long as
  /// the patches there are painted later: `forward` from the flange on side k - 1 away from this
  /// patch, otherwise against the outline's order from the flange on side k. True when the walk led
  /// all the way round, which joins the two flanges.
  bool walk_around(int h, bool forward) {
    std::vector<Vector2d> points;
    bool closed = false;
    int at_vertex = step(h, forward);
    for (bool first = true;; first = false) {
      const Geometry g = layer_.geometry(QuadMesh::quad_of(at_vertex));
      const int corner = QuadMesh::corner_of(at_vertex);
      const int across = step(at_vertex, forward);
      closed = across >= 0 && QuadMesh::quad_of(across) == quad_;
      if (closed) break;
      if (!first) points.push_back(diagonal(g, corner));
      const bool goes_on = across >= 0 && layer_.is_painted_later(quad_, QuadMesh::quad_of(across));
      const bool closes_next = goes_on && first && meets_again(across, forward);
      if (!goes_on || closes_next) points.push_back(far_edge(g, corner, forward));
      if (!goes_on) break;
      at_vertex = across;
    }
    if (!forward) std::reverse(points.begin(), points.end());
    for (const Vector2d& p : points) add_point(p);
    return closed;
  }

  /// True when the step after half-edge h leads back to this patch.
  bool meets_again(int h, bool forward) const {
    const int across = step(h, forward);
    return across >= 0 && QuadMesh::quad_of(across) == quad_;
  }

  /// The next half-edge that leaves the same vertex, or -1 at the border of the mesh: forward
  /// across the previous side of its quad, backward across its own.
  int step(int h, bool forward) const {
    const QuadMesh& mesh = layer_.mesh();
    if (forward) return mesh.twin(QuadMesh::prev(h));
    const int twin = mesh.twin(h);
    return twin < 0 ? -1 : QuadMesh::next(twin);
  }

  /// The point `bleed` away from both sides at a corner.
  Vector2d diagonal(const Geometry& g, int corner) const {
    const Vector2d uv = on_side(corner, 0);
    const double step_u = parameter_step(g, uv, true, bleed_);
    const double step_v = parameter_step(g, uv, false, bleed_);
    return at(g, {uv.x() + (uv.x() > 0.5 ? -step_u : step_u),
                  uv.y() + (uv.y() > 0.5 ? -step_v : step_v)});
  }

  /// The point `bleed` along the side on which the walk leaves the patch.
  Vector2d far_edge(const Geometry& g, int corner, bool forward) const {
    if (forward) return inside(g, corner, 0, bleed_);
    return inside(g, (corner + 3) & 3, 1, bleed_);
  }

  void add_point(const Vector2d& p) {
    auto& pieces = outline_.pieces;
    if (pieces.empty()) outline_.start = p;
    const bool goes_straight_on = pieces.size() >= 2 && pieces.back().is_line &&
                                  is_between(pieces[pieces.size() - 2].end, pieces.back().end, p);
    if (goes_straight_on) pieces.pop_back();
    pieces.push_back({true, p, p, p});
  }

  static bool is_between(const Vector2d& a, const Vector2d& middle, const Vector2d& b) {
    const Vector2d chord = b - a, to_middle = middle - a;
    const double along = to_middle.dot(chord), length = chord.norm();
    return along >= 0 && along <= length * length &&
           std::abs(chord.x() * to_middle.y() - chord.y() * to_middle.x()) <=
               kStraightness * length;
  }

  const SvgLayer& layer_;
  int quad_;
  ParameterBox cell_, box_;
  double bleed_;
  Geometry geometry_;
  BicubicBezier<Vector2d> bezier_;
  double orientation_ = 1;
  std::array<bool, 4> later_, clipped_;
  SvgOutline outline_;
};

}  // namespace

SvgOutline cell_outline(const SvgLayer& layer, int quad, const ParameterBox& cell, double bleed) {
  return OutlineBuilder(layer, quad, cell, bleed).build();
}

}  // namespace quadrille
