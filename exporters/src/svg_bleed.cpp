#include "svg_bleed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "svg_bleed_reach.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// How far cells go on beyond a clip, in bleeds: all over the pixels that the clip halves.
constexpr double kClippedBleed = 1.5;
/// The least sine of the angle between a side and the next along which a corner moves, the cosines
/// between two bleeds from which they are about one, and below which they make a spike; and the
/// least ratio of their lengths with which they meet.
constexpr double kLeastSlope = 0.5, kStraight = 0.95, kSpike = -0.3, kLeastRatio = 0.7;
/// The error that rounded seams may leave, in 8-bit steps, and bleeds as a share of their length;
/// less in masks, where a bleed that crosses a tear lets the hidden colours beyond show.
constexpr double kSlopeError = 8, kBleedShare = 0.25, kMaskBleedShare = 0.15;
/// And the most that corners at tears may be moved, in pixels: something of any colour lies below.
constexpr double kTornCorner = 0.04;
/// How far before its ends a bleed ends beside what has none, where masks are painted, in pixels.
constexpr double kInset = 0.5;
/// Holes with more cells than this are kept.
constexpr std::size_t kMostHoleCells = 64;

class Outliner {
 public:
  Outliner(const CellMesh& mesh, const CellGroup& group, double bleed)
      : mesh_(mesh), layer_(mesh.layer()), group_(group), bleed_(bleed), reach_(mesh, group) {}

  std::vector<SvgOutline> run() {
    for (const int c : group_.cells) {
      for (int s = mesh_.side_begin(c); s < mesh_.side_begin(c + 1); ++s) {
        if (is_outer(s)) outer_.push_back(s);
      }
    }
    std::sort(outer_.begin(), outer_.end());
    seen_.assign(outer_.size(), 0);
    std::vector<SvgOutline> outlines;
    for (std::size_t i = 0; i < outer_.size(); ++i) {
      if (seen_[i]) continue;
      const std::vector<int> loop = trace(outer_[i]);
      if (bleed_ > 0 && is_filled_hole(loop)) continue;
      outlines.push_back(outline(loop));
    }
    return outlines;
  }

 private:
  bool is_outer(int s) const {
    const int twin = mesh_.side(s).twin;
    return twin < 0 || !group_.holds(mesh_.side(twin).cell);
  }

  std::vector<int> trace(int first) {
    std::vector<int> loop;
    for (int s = first;;) {
      const auto place = std::lower_bound(outer_.begin(), outer_.end(), s) - outer_.begin();
      if (seen_[place]) break;
      seen_[place] = 1;
      loop.push_back(s);
      s = mesh_.side(s).next;
      while (!is_outer(s)) s = mesh_.side(mesh_.side(s).twin).next;
    }
    return loop;
  }

  /// True when only cells that are painted later lie within the loop, and not too many.
  bool is_filled_hole(const std::vector<int>& loop) const {
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d a = start(loop[i]), b = start(loop[(i + 1) % loop.size()]);
      area += a.x() * b.y() - a.y() * b.x();
    }
    if (area >= 0) return false;
    std::vector<int> found;
    const auto cross = [&](int s) {
      const int twin = mesh_.side(s).twin;
      if (twin < 0) return false;
      const int cell = mesh_.side(twin).cell;
      const bool is_known =
          group_.holds(cell) || std::find(found.begin(), found.end(), cell) != found.end();
      if (is_known) return true;
      if (found.size() == kMostHoleCells || !group_.is_later(cell)) return false;
      found.push_back(cell);
      return true;
    };
    if (!std::all_of(loop.begin(), loop.end(), cross)) return false;
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (int s = mesh_.side_begin(found[i]); s < mesh_.side_begin(found[i] + 1); ++s) {
        if (!cross(s)) return false;
      }
    }
    return true;
  }

  CellMesh::Beyond beyond(int s) const {
    const CellMesh::Side& side = mesh_.side(s);
    if (side.twin < 0) return side.beyond;
    if (group_.is_later(mesh_.side(side.twin).cell)) return CellMesh::Beyond::later;
    return side.is_torn ? CellMesh::Beyond::nothing : CellMesh::Beyond::seam;
  }
  bool has_bleed(int s) const {
    const CellMesh::Beyond what = beyond(s);
    return bleed_ > 0 && (what == CellMesh::Beyond::later || what == CellMesh::Beyond::clip);
  }

  SvgOutline outline(const std::vector<int>& loop) const {
    OutlineSimplifier simplifier(kSeamFlatness);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int s = loop[i];
      join(simplifier, loop[(i + loop.size() - 1) % loop.size()], s);
      if (beyond(s) == CellMesh::Beyond::nothing) {
        simplifier.add_exact(mesh_.curve(s));
        continue;
      }
      const bool bleeds = has_bleed(s);
      const auto points = mesh_.points(s);
      for (int j = 1; j < static_cast<int>(points.size()); ++j) {
        if (bleeds) {
          add_bleed(simplifier, points[j], step_beyond(s, mesh_.parameters(s, j)));
        } else {
          simplifier.add(points[j], tolerance_for(mesh_.slope(s, j)));
        }
      }
    }
    return simplifier.outline();
  }

  /// Adds the corner between two sides. A bleed that ends there ends on the line on which the side
  /// without one goes on.
  void join(OutlineSimplifier& to, int before, int after) const {
    const Vector2d corner = start(after);
    const bool ends = has_bleed(before), starts = has_bleed(after);
    const Bleed end = ends ? bleed_at(before, true) : Bleed{};
    const Bleed begin = starts ? bleed_at(after, false) : Bleed{};
    if (ends && starts) {
      if (const auto both = meeting(end, begin, before, after)) return add_bleed(to, corner, *both);
      add_bleed(to, corner, end.step);
      to.add(corner, corner_tolerance(before, after));
      return add_bleed(to, corner, begin.step);
    }
    if (ends) {
      const Vector2d step = last_step(end, -direction_at_start(after), before, after, after);
      add_end(to, corner, step, -direction_at_end(before));
    }
    // The start of an exact side is added with it.
    if (beyond(after) != CellMesh::Beyond::nothing) {
      const double slope =
          std::max(ends ? 0 : slope_at_end(before), starts ? 0 : mesh_.slope(after, 0));
      to.add(corner, std::min(tolerance_for(slope), corner_tolerance(before, after)));
    }
    if (starts) {
      const Vector2d step = last_step(begin, direction_at_end(before), after, before, after);
      add_end(to, corner, step, direction_at_start(after));
    }
  }

  /// Adds the end of a bleed; `inward` is the direction of its side away from the end. The smallest
  /// overlap with what is painted earlier shows in a mask, whose values jump where colours do not.
  void add_end(OutlineSimplifier& to, const Vector2d& corner, const Vector2d& step,
               const Vector2d& inward) const {
    if (mesh_.paint() == CellPaint::color) return add_bleed(to, corner, step);
    const double beyond = std::max(0.0, kInset - step.dot(inward));
    to.add(corner + step + beyond * inward, 0);
  }

  /// The bleed of a side at these parameters on it.
  Vector2d step_beyond(int s, const Vector2d& uv) const {
    const bool is_clip = beyond(s) == CellMesh::Beyond::clip;
    return is_clip ? reach_.step(s, uv, kClippedBleed * bleed_, true)
                   : reach_.step(s, uv, bleed_, false);
  }

  static double tolerance_for(double slope) { return kSlopeError / std::max(slope, 1e-9); }
  /// How far the corner between two sides may be moved.
  double corner_tolerance(int before, int after) const {
    const bool on_tear =
        mesh_.side(before).is_torn || mesh_.side(after).is_torn || starts_at_tear(after);
    return on_tear ? kTornCorner : std::numeric_limits<double>::infinity();
  }
  double slope_at_end(int s) const {
    return mesh_.slope(s, static_cast<int>(mesh_.points(s).size()) - 1);
  }
  /// Where there is little room for it, a bleed must not be rounded much.
  void add_bleed(OutlineSimplifier& to, const Vector2d& point, const Vector2d& step) const {
    const double share = mesh_.paint() == CellPaint::alpha ? kMaskBleedShare : kBleedShare;
    to.add(point + step, share * step.norm());
  }

  /// The bleed of a side at one of its ends.
  struct Bleed {
    Vector2d step = {0, 0};
    Vector2d normal = {0, 0};  ///< of the side, outward
    double depth = 0;          ///< how far the step leads along the normal
  };
  Bleed bleed_at(int s, bool at_end) const {
    const CellMesh::Side& side = mesh_.side(s);
    Bleed bleed;
    bleed.step = step_beyond(s, at_end ? side.to : side.from);
    const Vector2d along = at_end ? direction_at_end(s) : direction_at_start(s);
    bleed.normal = {along.y(), -along.x()};
    bleed.depth = bleed.step.dot(bleed.normal);
    if (bleed.depth < 0) bleed.normal = -bleed.normal, bleed.depth = -bleed.depth;
    return bleed;
  }

  /// The step in the given direction that leads across a side as far as its bleed, or the bleed
  /// where that direction leads along the side.
  static Vector2d along(const Vector2d& direction, const Bleed& bleed) {
    const double slope = direction.dot(bleed.normal);
    return slope > kLeastSlope ? Vector2d(direction * (bleed.depth / slope)) : bleed.step;
  }

  /// The step with which a bleed ends at the start of side `corner`, beside a side without one: on
  /// the line of that side, on which the bleed of the cell beyond ends too, where the bleed may go
  /// there. Beside a tear its own step follows the tear.
  Vector2d last_step(const Bleed& bleed, const Vector2d& line, int bleeding, int beside,
                     int corner) const {
    if (mesh_.side(beside).is_torn) return bleed.step;
    const Vector2d step = along(line, bleed);
    return may_go_on(bleeding, corner, step) ? step : bleed.step;
  }

  /// Where two bleeds meet; nothing where they do not, or above what is painted earlier.
  std::optional<Vector2d> meeting(const Bleed& end, const Bleed& begin, int before,
                                  int after) const {
    const Vector2d &n = end.normal, &m = begin.normal;
    const double a = end.depth, b = begin.depth, cosine = n.dot(m);
    if (cosine > kStraight) return 0.5 * (end.step + begin.step);
    if (cosine < kSpike || std::min(a, b) < kLeastRatio * std::max(a, b)) return {};
    const double turn = n.x() * m.y() - n.y() * m.x();  // positive where the group is convex
    if (turn > 0 && !all_later_around(before, after)) return {};
    const double divisor = 1 - cosine * cosine;
    const Vector2d step = (a - cosine * b) / divisor * n + (b - cosine * a) / divisor * m;
    if (crosses_tear(before, after, step) || ends_uncovered(after, step)) return {};
    return step;
  }

  /// True when a step from the corner between two sides crosses a tear of the patches there. Where
  /// patches are thin it may, though each side's own bleed does not.
  bool crosses_tear(int before, int after, const Vector2d& step) const {
    using enum CellMesh::Beyond;
    if (beyond(before) == clip || beyond(after) == clip) return false;
    const auto fan = fan_at_start(after);
    if (!fan.empty()) {
      return std::any_of(fan.begin(), fan.end(), [&](int h) {
        return reach_.crosses_tear(QuadMesh::quad_of(h), start(after), step);
      });
    }
    for (const int s : {before, after}) {
      const int own = mesh_.quad(mesh_.side(s).cell);
      const int twin = mesh_.side(s).on_border ? layer_.mesh().twin(4 * own + mesh_.side(s).k) : -1;
      if (reach_.crosses_tear(own, start(after), step)) return true;
      if (twin >= 0 && reach_.crosses_tear(QuadMesh::quad_of(twin), start(after), step))
        return true;
    }
    return false;
  }

  /// True when a step from the start of a side at a tear ends over what is painted earlier. The
  /// patches there may be covered at the vertex itself but not as far as the step goes.
  bool ends_uncovered(int s, const Vector2d& step) const {
    if (!starts_at_tear(s)) return false;
    const auto fan = fan_at_start(s);
    return std::any_of(fan.begin(), fan.end(),
                       [&](int h) { return leads_into(step, h) && !reach_.ends_covered(h, step); });
  }

  /// The fan around the vertex at which a side starts; empty when it starts elsewhere.
  std::span<const int> fan_at_start(int s) const {
    const CellMesh::Side& side = mesh_.side(s);
    const auto is_end = [](double t) { return t == 0 || t == 1; };
    if (!is_end(side.from.x()) || !is_end(side.from.y())) return {};
    const int corner =
        side.from.y() == 0 ? (side.from.x() == 0 ? 0 : 1) : (side.from.x() == 0 ? 3 : 2);
    const QuadMesh& quads = layer_.mesh();
    return quads.fan(quads.origin(4 * mesh_.quad(side.cell) + corner));
  }

  bool starts_at_tear(int s) const {
    const auto fan = fan_at_start(s);
    return std::any_of(fan.begin(), fan.end(),
                       [&](int h) { return layer_.mesh().is_tear(layer_.mesh().edge(h)); });
  }

  /// True when a bleed may lead along this step from the start of side `corner`: at a vertex of a
  /// tear not onto what is painted earlier, unless a clip cuts it off there, which it does in other
  /// parts.
  bool may_go_on(int bleeding, int corner, const Vector2d& step) const {
    if (!starts_at_tear(corner)) return true;
    const auto fan = fan_at_start(corner);
    const int own = mesh_.quad(mesh_.side(bleeding).cell);
    const bool is_clip = beyond(bleeding) == CellMesh::Beyond::clip;
    return std::none_of(fan.begin(), fan.end(), [&](int h) {
      const bool is_cut_off = is_clip && layer_.part(QuadMesh::quad_of(h)) != layer_.part(own);
      return !is_cut_off && !is_hidden_in(own, h) && leads_into(step, h);
    });
  }

  /// True when a step from the origin of half-edge h leads into its quad.
  bool leads_into(const Vector2d& step, int h) const {
    const PlaneCurve next = edge_curve(layer_.layer(), h);
    const PlaneCurve previous = edge_curve(layer_.layer(), QuadMesh::prev(h));
    Vector2d from = direction(next[0], next[1], next[3]);
    Vector2d to = direction(previous[3], previous[2], previous[0]);
    if (layer_.layer().transform.linear().determinant() < 0) std::swap(from, to);
    const auto turn_to = [from](const Vector2d& other) {
      const double angle = std::atan2(from.x() * other.y() - from.y() * other.x(), from.dot(other));
      return angle < 0 ? angle + 2 * std::numbers::pi : angle;
    };
    return turn_to(step) < turn_to(to);
  }

  /// True when all other cells around the start of side `after` are painted later.
  bool all_later_around(int before, int after) const {
    if (const auto fan = fan_at_start(after); !fan.empty()) {
      const int own = mesh_.quad(mesh_.side(after).cell);
      return std::all_of(fan.begin(), fan.end(), [&](int h) { return is_hidden_in(own, h); });
    }
    int s = mesh_.side(before).twin;
    while (s >= 0) {
      s = mesh_.side(s).prev;
      const int twin = mesh_.side(s).twin;
      if (twin == after || twin < 0) break;
      if (!group_.is_later(mesh_.side(twin).cell)) return false;
      s = twin;
    }
    return true;
  }

  /// True when the bleed of a patch is hidden at the origin of half-edge h in its quad.
  bool is_hidden_in(int own, int h) const {
    const int cell = mesh_.cell_at(h), quad = QuadMesh::quad_of(h);
    if (cell >= 0) return group_.holds(cell) || group_.is_later(cell);
    return layer_.opacity(quad) == PatchOpacity::transparent || mesh_.is_hidden_in(own, quad);
  }

  Vector2d start(int s) const { return mesh_.points(s).front(); }
  Vector2d direction_at_start(int s) const {
    const PlaneCurve curve = mesh_.curve(s);
    return direction(curve[0], curve[1], curve[3]);
  }
  Vector2d direction_at_end(int s) const {
    const PlaneCurve curve = mesh_.curve(s);
    return -direction(curve[3], curve[2], curve[0]);
  }
  static Vector2d direction(const Vector2d& from, const Vector2d& near, const Vector2d& far) {
    const Vector2d to_near = near - from;
    return (to_near.norm() > 1e-6 ? to_near : Vector2d(far - from)).normalized();
  }

  const CellMesh& mesh_;
  const SvgLayer& layer_;
  const CellGroup& group_;
  double bleed_;
  BleedReach reach_;
  std::vector<int> outer_;  ///< sides of the group, ascending
  std::vector<char> seen_;
};

}  // namespace

std::vector<SvgOutline> group_outlines(const CellMesh& mesh, const CellGroup& group, double bleed) {
  return Outliner(mesh, group, bleed).run();
}

}  // namespace quadrille
