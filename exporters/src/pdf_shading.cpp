#include "pdf_shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "patch_sides.h"
#include "pdf_deflate.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Geometry = BicubicHermite<Vector2d>;

/// In pixels: how far patches overlap their neighbours, a step of the grid at 16 bits and four at
/// 24; how far they go on beyond the page, and beyond edges that are cut off with anti-aliasing or
/// hidden.
constexpr double kOverlap = 0.0625, kBeyondPage = 0.5, kBeyondEdge = 0.75;
/// The same in parameters of a patch, at most.
constexpr double kWidestOverlap = 0.25, kWidestReach = 0.5;
/// How much of a neighbour may be reached below; its far side may be curved.
constexpr double kShareOfRoom = 0.625;

struct GridPoint {
  std::uint32_t x = 0, y = 0;
};

GridPoint to_grid(const CoordinateGrid& grid, const Vector2d& p) {
  const double most = std::ldexp(1.0, grid.bits) - 1;
  // A little more than a half: patches that share a point round it alike, whatever its last bits.
  const auto number = [&](double pixel, double origin) {
    const double steps = std::floor((pixel - origin) / grid.unit + 0.500001);
    return static_cast<std::uint32_t>(std::clamp(steps, 0.0, most));
  };
  return {number(p.x(), grid.origin.x()), number(p.y(), grid.origin.y())};
}

/// How fast the patch moves away from its side, in pixels per parameter: the least of its ends and
/// middle, or the most.
std::array<double, 2> speed_from_side(const Geometry& g, int side) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double t : {0.0, 0.5, 1.0}) {
    const Vector2d uv = on_side(side, t);
    const Vector2d du = g.derivative_u(uv.x(), uv.y()), dv = g.derivative_v(uv.x(), uv.y());
    const double along = side & 1 ? dv.norm() : du.norm();
    const double area = std::abs(du.x() * dv.y() - du.y() * dv.x());
    const double speed = along > 0 ? area / along : 0;
    least = std::min(least, speed), most = std::max(most, speed);
  }
  return {least, most};
}

double parameters(double pixels, double speed, double most) {
  return pixels < most * speed ? pixels / speed : most;
}

/// The least of the distances, in pixels, at which the patch ends opposite of a side.
double thickness(const Geometry& g, int side) {
  double least = std::numeric_limits<double>::infinity();
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Vector2d uv = on_side(side, t), far = on_side((side + 2) & 3, 1 - t);
    const Vector2d along =
        side & 1 ? g.derivative_v(uv.x(), uv.y()) : g.derivative_u(uv.x(), uv.y());
    const Vector2d over = g.at(far.x(), far.y()) - g.at(uv.x(), uv.y());
    const double area = std::abs(along.x() * over.y() - along.y() * over.x());
    least = std::min(least, along.norm() > 0 ? area / along.norm() : 0);
  }
  return least;
}

/// How far, in parameters, a patch goes on beyond a side where it is hidden or cut off: not beyond
/// the patch that lies there.
double reach(const Layer& layer, const PaintGroups& groups, int quad, const Geometry& g, int side) {
  const auto [least, most] = speed_from_side(g, side);
  const int twin = layer.patches.mesh.twin(4 * quad + side);
  if (twin < 0) {
    return parameters(groups.open_border ? kBeyondPage : kBeyondEdge, least, kWidestReach);
  }
  const Geometry beyond = placed_geometry(layer, QuadMesh::quad_of(twin));
  const int from = QuadMesh::corner_of(twin);
  const double room =
      kShareOfRoom * std::min(speed_from_side(beyond, from)[0], thickness(beyond, from));
  return parameters(std::min(kBeyondEdge, room), most, kWidestReach);
}

/// The parameters between which a patch is drawn.
ParameterBox drawn_box(const Layer& layer, const PaintGroups& groups, const PatchVisit& visit,
                       const Divisions& count, const Geometry& g) {
  std::array<double, 4> beyond;
  for (int side = 0; side < 4; ++side) {
    const double overlap = parameters(kOverlap, speed_from_side(g, side)[0], kWidestOverlap);
    switch (across(layer.patches.mesh, groups, 4 * visit.quad + side)) {
      case Across::same:
        beyond[side] = side == visit.entry || side == visit.exit ? 0 : overlap;
        break;
      case Across::smooth:
        beyond[side] = overlap;
        break;
      case Across::tangled:
        beyond[side] = 0;
        break;
      default:
        beyond[side] = reach(layer, groups, visit.quad, g, side);
    }
    // Colours go on as they come, but not farther than a cell.
    beyond[side] = std::min(beyond[side], 1.0 / (side & 1 ? count.u : count.v));
  }
  return {-beyond[3], -beyond[0], 1 + beyond[1], 1 + beyond[2]};
}

struct DrawnCell {
  std::array<std::array<GridPoint, 4>, 4> side;  ///< from corner k to corner k + 1
  std::array<CellTable::Node, 4> corner;
};

/// The colour at a corner of cell (i, j), moved along to where the patch ends.
CellTable::Node drawn_node(const CellTable& cells, int quad, const ParameterBox& box, int i,
                           int j) {
  const auto shift = [](int index, int count, double low, double high) {
    return index == 0 ? low * count : index == count ? (high - 1) * count : 0;
  };
  const double du = shift(i, cells.count(quad).u, box.u0, box.u1);
  const double dv = shift(j, cells.count(quad).v, box.v0, box.v1);
  const auto& here = cells.node(quad, i, j);
  if (du == 0 && dv == 0) return here;
  const auto& beside_u = cells.node(quad, i == 0 ? 1 : i - 1, j);
  const auto& beside_v = cells.node(quad, i, j == 0 ? 1 : j - 1);
  CellTable::Node color{};
  for (int c = 0; c < 3; ++c) {
    const double moved =
        here[c] + std::abs(du) * (here[c] - beside_u[c]) + std::abs(dv) * (here[c] - beside_v[c]);
    color[c] = static_cast<std::uint8_t>(std::clamp(std::lround(moved), 0l, 255l));
  }
  return color;
}

class CoonsWriter {
 public:
  CoonsWriter(const Layer& layer, const PaintGroups& groups, const CellTable& cells,
              const CoordinateGrid& grid, int channels, ScratchFile& scratch)
      : layer_(layer),
        groups_(groups),
        cells_(cells),
        grid_(grid),
        channels_(channels),
        out_(record_bytes(), scratch) {}

  int record_bytes() const { return 1 + 8 * point_bytes() + 2 * channels_; }

  void add_all(const std::vector<PatchVisit>& visits, const std::function<void(double)>& progress) {
    constexpr std::size_t kPerReport = 1024;
    for (std::size_t i = 0; i < visits.size(); ++i) {
      if (i % kPerReport == 0) progress(double(i) / double(visits.size()));
      if (i == 0) fillers_ = fillers(visits);
      add(visits[i]);
    }
  }

  ScratchRange finish() { return out_.finish(); }

 private:
  int point_bytes() const { return 2 * grid_.bits / 8; }

  /// Readers take whatever fills up the last row of the predictor for patches. So rows are filled
  /// by some: points, before the first patch, which hides them. A patch that shares no side takes
  /// four points and two colours more than a row.
  int fillers(const std::vector<PatchVisit>& visits) const {
    const auto shares = [](const PatchVisit& visit) { return visit.entry >= 0; };
    const auto starts = visits.size() - std::count_if(visits.begin(), visits.end(), shares);
    const std::size_t more = 4 * point_bytes() + 2 * channels_;
    int count = 0;
    while ((starts + count) * more % record_bytes() != 0) ++count;
    return count;
  }

  void add(const PatchVisit& visit) {
    const Divisions count = cells_.count(visit.quad);
    const Geometry geometry = placed_geometry(layer_, visit.quad);
    const BicubicBezier<Vector2d> bezier = to_bezier(geometry);
    const ParameterBox box = drawn_box(layer_, groups_, visit, count, geometry);
    const std::vector<CellStep> steps = visit.cells(count);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const int exit = k + 1 < steps.size() ? (steps[k + 1].entry + 2) & 3 : visit.exit;
      write(drawn(visit.quad, bezier, box, steps[k]), steps[k], exit);
    }
  }

  DrawnCell drawn(int quad, const BicubicBezier<Vector2d>& bezier, const ParameterBox& box,
                  const CellStep& step) const {
    const auto knot = [](int index, int count, double low, double high) {
      return index == 0 ? low : index == count ? high : double(index) / count;
    };
    const Divisions n = cells_.count(quad);
    const BicubicBezier<Vector2d> part = sub_patch(
        bezier, {knot(step.i, n.u, box.u0, box.u1), knot(step.j, n.v, box.v0, box.v1),
                 knot(step.i + 1, n.u, box.u0, box.u1), knot(step.j + 1, n.v, box.v0, box.v1)});
    DrawnCell cell;
    for (int side = 0; side < 4; ++side) {
      const PlaneCurve curve = side_curve(part, side);
      for (int p = 0; p < 4; ++p) cell.side[side][p] = to_grid(grid_, curve[p]);
    }
    constexpr int kRight[] = {0, 1, 1, 0}, kLow[] = {0, 0, 1, 1};
    for (int c = 0; c < 4; ++c) {
      cell.corner[c] = drawn_node(cells_, quad, box, step.i + kRight[c], step.j + kLow[c]);
    }
    return cell;
  }

  /// Runs around the cell from its entry. The shared side keeps its direction, so that cells are
  /// run around alternately one way and the other.
  void write(const DrawnCell& cell, const CellStep& step, int exit) {
    if (!step.shares_entry) turn_ = 1, flag_ = 0;
    const int entry = step.shares_entry || exit < 0 ? step.entry : (exit + 2) & 3;
    record_.clear();
    record_.push_back(static_cast<std::uint8_t>(flag_));
    for (int k = 0; k < 4; ++k) {
      const auto& side = cell.side[(entry + turn_ * k) & 3];
      for (int p = k == 0 ? 0 : 1; p < (k == 3 ? 3 : 4); ++p) {
        if (k > 0 || flag_ == 0) add_point(side[turn_ > 0 ? p : 3 - p]);
      }
    }
    for (int k = flag_ == 0 ? 0 : 2; k < 4; ++k) {
      const auto& color = cell.corner[(entry + (turn_ > 0 ? k : 1 - k)) & 3];
      record_.insert(record_.end(), color.begin(), color.begin() + channels_);
    }
    for (; fillers_ > 0; --fillers_) out_.add(point_patch());
    out_.add(record_);
    if (exit >= 0) flag_ = (turn_ * (exit - entry)) & 3;
    turn_ = -turn_;
  }

  /// All of a patch in the first corner of the one in record_, which shares no side.
  std::vector<std::uint8_t> point_patch() const {
    const auto point = record_.begin() + 1, color = point + 12 * point_bytes();
    std::vector<std::uint8_t> patch = {0};
    for (int k = 0; k < 12; ++k) patch.insert(patch.end(), point, point + point_bytes());
    for (int k = 0; k < 4; ++k) patch.insert(patch.end(), color, color + channels_);
    return patch;
  }

  void add_point(const GridPoint& p) {
    for (const std::uint32_t number : {p.x, p.y}) {
      for (int shift = grid_.bits - 8; shift >= 0; shift -= 8) {
        record_.push_back(static_cast<std::uint8_t>(number >> shift));
      }
    }
  }

  const Layer& layer_;
  const PaintGroups& groups_;
  const CellTable& cells_;
  const CoordinateGrid& grid_;
  int channels_;
  RecordDeflater out_;
  std::vector<std::uint8_t> record_;
  int fillers_ = 0;
  int turn_ = 1, flag_ = 0;
};

}  // namespace

CoordinateGrid CoordinateGrid::covering(const Eigen::AlignedBox2d& box) {
  constexpr double kFine = 1.0 / 16, kFiner = 1.0 / 64;
  CoordinateGrid grid;
  if (box.isEmpty()) return grid;
  grid.origin = box.min().array().floor();
  const double length = (box.max() - grid.origin).maxCoeff();
  grid.bits = length < 65535 * kFine ? 16 : 24;
  grid.unit = grid.bits == 16 ? kFine : kFiner;
  while (length > (std::ldexp(1.0, grid.bits) - 1) * grid.unit) grid.unit *= 2;
  return grid;
}

double CoordinateGrid::largest(int axis) const {
  return origin[axis] + unit * (std::ldexp(1.0, bits) - 1);
}

CoonsShading coons_shading(const Layer& layer, const PaintGroups& groups,
                           const std::vector<PatchVisit>& visits, const CellTable& cells,
                           const CoordinateGrid& grid, ShadedQuantity quantity,
                           ScratchFile& scratch, const std::function<void(double)>& progress) {
  CoonsShading shading;
  shading.channels = channels_of(quantity);
  if (visits.empty()) return shading;
  CoonsWriter writer(layer, groups, cells, grid, shading.channels, scratch);
  shading.record_bytes = writer.record_bytes();
  writer.add_all(visits, progress);
  shading.data = writer.finish();
  return shading;
}

}  // namespace quadrille
