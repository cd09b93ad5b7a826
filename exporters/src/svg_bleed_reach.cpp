#include "svg_bleed_reach.h"

#include <algorithm>
#include <cmath>

#include "patch_sides.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Geometry = BicubicHermite<Vector2d>;

/// How often a bleed is halved, and how many thin patches it crosses at most.
constexpr int kMostHalvings = 4, kMostCrossed = 4;

Vector2d point_at(const Geometry& g, const Vector2d& uv) { return g.at(uv.x(), uv.y()); }

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// True when the lines a b and c d have a point in common, other than a.
bool cross_each_other(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  constexpr double kAtStart = 1e-6;
  const double divisor = cross(b - a, d - c);
  if (divisor == 0) return false;
  const double t = cross(c - a, d - c) / divisor, u = cross(c - a, b - a) / divisor;
  return t > kAtStart && t <= 1 && u >= 0 && u <= 1;
}

/// Parameters beyond a side within a patch.
Vector2d across_line(const Geometry& g, const CellMesh::Side& side, const Vector2d& uv,
                     double bleed) {
  const bool across_u = side.k == 1 || side.k == 3;
  const int axis = across_u ? 0 : 1;
  const double step = parameter_step(g, uv, across_u, bleed);
  Vector2d target = uv;
  target[axis] = std::clamp(uv[axis] + (side.k == 1 || side.k == 2 ? step : -step), 0.0, 1.0);
  return target;
}

/// The step beyond the border of the mesh.
Vector2d outward(const Geometry& g, const CellMesh::Side& side, const Vector2d& uv, double bleed) {
  const bool along_u = side.k == 0 || side.k == 2;
  Vector2d along = along_u ? g.derivative_u(uv.x(), uv.y()) : g.derivative_v(uv.x(), uv.y());
  if (side.k >= 2) along = -along;
  const Vector2d du = g.derivative_u(0.5, 0.5), dv = g.derivative_v(0.5, 0.5);
  const double orientation = cross(du, dv) < 0 ? -1 : 1;
  return orientation * bleed * Vector2d(along.y(), -along.x()).normalized();
}

}  // namespace

Vector2d BleedReach::step(int s, const Vector2d& uv, double bleed, bool is_clipped) const {
  const CellMesh::Side& side = mesh_.side(s);
  const Geometry& g = mesh_.geometry(side.cell);
  const Vector2d point = point_at(g, uv);
  const int q = mesh_.quad(side.cell), twin = layer_.mesh().twin(4 * q + side.k);
  if (side.on_border && layer_.is_border(4 * q + side.k)) return outward(g, side, uv, bleed);
  Vector2d target = point;
  for (int halving = 0; halving < kMostHalvings; ++halving, bleed *= 0.5) {
    const auto [quad, at] = side.on_border ? across_border(side, uv, twin, bleed)
                                           : std::pair(q, across_line(g, side, uv, bleed));
    const int cell = mesh_.cell_with(quad, at);
    target = point_at(geometry(quad), at);
    if (is_clipped || cell < 0 || group_.holds(cell) || group_.is_later(cell)) break;
  }
  return target - point;
}

/// The patch beyond a side that lies on the border of its own, and parameters there. Thin patches
/// are crossed as long as they are painted later.
std::pair<int, Vector2d> BleedReach::across_border(const CellMesh::Side& side, const Vector2d& uv,
                                                   int twin, double bleed) const {
  const double along = side.k == 1 || side.k == 3 ? uv.y() : uv.x();
  const double place = side.k < 2 ? 1 - along : along;
  const QuadMesh& quads = layer_.mesh();
  const int own = mesh_.quad(side.cell);
  for (int crossed = 0, h = twin;; ++crossed) {
    const int quad = QuadMesh::quad_of(h), k = QuadMesh::corner_of(h);
    const Geometry& its = geometry(quad);
    const double depth = parameter_step(its, on_side(k, place), k == 1 || k == 3, bleed);
    const int far = 4 * quad + ((k + 2) & 3), next = quads.twin(far);
    const double width =
        (point_at(its, on_side(k, place, 1)) - point_at(its, on_side(k, place))).norm();
    const bool is_thin =
        bleed > 0.5 * width && crossed < kMostCrossed && next >= 0 &&
        !quads.is_tear(quads.edge(far)) && is_covered(own, quad, on_side(k, place, 0.5)) &&
        is_covered(own, QuadMesh::quad_of(next), on_side(QuadMesh::corner_of(next), place));
    if (!is_thin) return {quad, on_side(k, place, depth)};
    if (bleed <= width) return {quad, on_side(k, place, bleed / width)};
    bleed -= width;
    h = next;
  }
}

/// True when the group, or what is painted later, is at these parameters.
bool BleedReach::is_covered(int own, int quad, const Vector2d& uv) const {
  const int cell = mesh_.cell_with(quad, uv);
  return cell < 0 ? mesh_.is_hidden_in(own, quad) : group_.holds(cell) || group_.is_later(cell);
}

bool BleedReach::ends_covered(int h, const Vector2d& step) const {
  constexpr int kNewtonSteps = 4;
  const int quad = QuadMesh::quad_of(h), own = mesh_.quad(group_.cells.front());
  const Geometry& g = geometry(quad);
  Vector2d uv = on_side(QuadMesh::corner_of(h), 0);
  const Vector2d target = point_at(g, uv) + step;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vector2d du = g.derivative_u(uv.x(), uv.y()), dv = g.derivative_v(uv.x(), uv.y());
    const double determinant = cross(du, dv);
    if (determinant == 0) break;
    const Vector2d miss = target - point_at(g, uv);
    uv += Vector2d(cross(miss, dv), cross(du, miss)) / determinant;
    uv = uv.cwiseMax(0).cwiseMin(1);
  }
  return is_covered(own, quad, uv);
}

bool BleedReach::crosses_tear(int quad, const Vector2d& from, const Vector2d& step) const {
  constexpr int kLines = 4;  // of a side
  const QuadMesh& quads = layer_.mesh();
  for (int k = 0; k < 4; ++k) {
    if (!quads.is_tear(quads.edge(4 * quad + k))) continue;
    const Geometry& g = geometry(quad);
    Vector2d end = point_at(g, on_side(k, 0));
    for (int i = 1; i <= kLines; ++i) {
      const Vector2d begin = end;
      end = point_at(g, on_side(k, double(i) / kLines));
      if (cross_each_other(from, from + step, begin, end)) return true;
    }
  }
  return false;
}

const Geometry& BleedReach::geometry(int quad) const {
  if (const Geometry* known = mesh_.find_geometry(quad)) return *known;
  if (quad != neighbor_) neighbor_geometry_ = layer_.geometry(neighbor_ = quad);
  return neighbor_geometry_;
}

}  // namespace quadrille
