#include "svg_cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "patch_sides.h"
#include "svg_slope.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// Farthest that the polyline of a side may be from it, in pixels, and its most lines.
constexpr double kFlatness = 0.1;
constexpr int kMostLines = 8;

bool is_along_u(int k) { return k == 0 || k == 2; }

/// The coordinate of a box that is constant along its side k.
double place_of(const ParameterBox& box, int k) {
  return k == 0 ? box.v0 : k == 1 ? box.u1 : k == 2 ? box.v1 : box.u0;
}

int lines_along(const PlaneCurve& curve) {
  int lines = 1;
  for (; lines < kMostLines; ++lines) {
    bool is_flat = true;
    for (int i = 0; i < lines && is_flat; ++i) {
      const double t0 = double(i) / lines, t1 = double(i + 1) / lines;
      is_flat = chord_distance(sub_curve(curve, t0, t1)) <= kFlatness;
    }
    if (is_flat) break;
  }
  return lines;
}

void sort_unique(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

CellMesh::CellMesh(const SvgLayer& layer, const std::vector<PatchCell>& cells, CellPaint paint)
    : layer_(layer), paint_(paint), cells_(cells) {
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
    const auto [entry, is_new] = patches_.try_emplace(cells[c].quad);
    Patch& patch = entry->second;
    if (is_new) {
      patch.geometry = layer.geometry(cells[c].quad);
      patch.color = layer.color(cells[c].quad);
      patch.bezier = to_bezier(patch.geometry);
      patch.first_cell = c;
    }
    ++patch.cell_count;
    const ParameterBox& b = cells[c].box;
    const bool at_corner[] = {b.u0 == 0 && b.v0 == 0, b.u1 == 1 && b.v0 == 0,
                              b.u1 == 1 && b.v1 == 1, b.u0 == 0 && b.v1 == 1};
    for (int k = 0; k < 4; ++k) {
      if (at_corner[k]) patch.corner_cell[k] = c;
    }
  }
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) add_sides(c);
  side_begin_.push_back(static_cast<int>(sides_.size()));
  link_twins();
}

int CellMesh::cell_at(int h) const {
  const auto found = patches_.find(QuadMesh::quad_of(h));
  return found == patches_.end() ? -1 : found->second.corner_cell[QuadMesh::corner_of(h)];
}

int CellMesh::cell_with(int quad, const Vector2d& uv) const {
  const auto found = patches_.find(quad);
  if (found == patches_.end()) return -1;
  const Patch& patch = found->second;
  for (int c = patch.first_cell; c < patch.first_cell + patch.cell_count; ++c) {
    const ParameterBox& b = cells_[c].box;
    if (uv.x() >= b.u0 && uv.x() <= b.u1 && uv.y() >= b.v0 && uv.y() <= b.v1) return c;
  }
  return -1;
}

PlaneCurve CellMesh::curve(int s) const {
  const Side& side = sides_[s];
  const Vector2d low = side.from.cwiseMin(side.to), high = side.from.cwiseMax(side.to);
  const ParameterBox box{low.x(), low.y(), high.x(), high.y()};
  return side_curve(sub_patch(patches_.at(quad(side.cell)).bezier, box), side.k);
}

std::vector<double> CellMesh::ends_along(const Patch& patch, int k, double at) const {
  std::vector<double> ends;
  for (int c = patch.first_cell; c < patch.first_cell + patch.cell_count; ++c) {
    const ParameterBox& b = cells_[c].box;
    if (is_along_u(k) ? b.v0 == at || b.v1 == at : b.u0 == at || b.u1 == at) {
      ends.insert(ends.end(), {is_along_u(k) ? b.u0 : b.v0, is_along_u(k) ? b.u1 : b.v1});
    }
  }
  sort_unique(ends);
  return ends;
}

/// The same along side k of a patch, with those of the patch on its other side.
std::vector<double> CellMesh::ends_along_side(int quad, int k) const {
  std::vector<double> ends = ends_along(patches_.at(quad), k, k == 1 || k == 2 ? 1 : 0);
  const int twin = layer_.mesh().twin(4 * quad + k);
  const auto other = twin < 0 ? patches_.end() : patches_.find(QuadMesh::quad_of(twin));
  if (other == patches_.end()) return ends;
  const int its = QuadMesh::corner_of(twin);
  for (const double end : ends_along(other->second, its, its == 1 || its == 2 ? 1 : 0)) {
    const bool reversed = (k < 2) == (its < 2);  // sides 0 and 1 run upward
    ends.push_back(reversed ? 1 - end : end);
  }
  sort_unique(ends);
  return ends;
}

void CellMesh::add_sides(int cell) {
  side_begin_.push_back(static_cast<int>(sides_.size()));
  const auto [q, box] = cells_[cell];
  const Vector2d corners[] = {
      {box.u0, box.v0}, {box.u1, box.v0}, {box.u1, box.v1}, {box.u0, box.v1}};
  for (int k = 0; k < 4; ++k) {
    const double place = place_of(box, k);
    const bool on_border = place == (k == 1 || k == 2 ? 1 : 0);
    std::vector<double> ends =
        on_border ? ends_along_side(q, k) : ends_along(patches_.at(q), k, place);
    const int axis = is_along_u(k) ? 0 : 1;
    const Vector2d last = corners[(k + 1) & 3];
    if (k >= 2) std::reverse(ends.begin(), ends.end());
    Vector2d from = corners[k];
    const auto [low, high] = std::minmax(from[axis], last[axis]);
    for (const double end : ends) {
      if (end <= low || end >= high) continue;
      Vector2d to = from;
      to[axis] = end;
      add_side(cell, k, on_border, from, to);
      from = to;
    }
    add_side(cell, k, on_border, from, last);
  }
  const int begin = side_begin_.back(), end = static_cast<int>(sides_.size());
  for (int s = begin; s < end; ++s) {
    sides_[s].next = s + 1 < end ? s + 1 : begin;
    sides_[s].prev = s > begin ? s - 1 : end - 1;
  }
}

void CellMesh::add_side(int cell, int k, bool on_border, const Vector2d& from, const Vector2d& to) {
  const int s = static_cast<int>(sides_.size());
  Side& side = sides_.emplace_back(
      Side{.cell = cell, .k = k, .on_border = on_border, .from = from, .to = to});
  side.first_point = static_cast<int>(points_.size());
  side.point_count = lines_along(curve(s));
  for (int i = 0; i < side.point_count; ++i) {
    const Vector2d uv = parameters(s, i);
    points_.push_back(geometry(cell).at(uv.x(), uv.y()));
    slopes_.push_back(slope_across(patches_.at(quad(cell)), k, uv));
  }
}

double CellMesh::slope_across(const Patch& patch, int k, const Vector2d& uv) const {
  const Vector2d along = is_along_u(k) ? patch.geometry.derivative_u(uv.x(), uv.y())
                                       : patch.geometry.derivative_v(uv.x(), uv.y());
  const double length = along.norm();
  if (length < 1e-9) return 0;
  const Vector2d across = Vector2d(along.y(), -along.x()) / length;
  const auto slopes = paint_slopes(patch.geometry, patch.color, paint_, uv.x(), uv.y());
  const double alpha = patch.color.at(uv.x(), uv.y())[3];
  const double weight = paint_ == CellPaint::alpha ? 1 : std::clamp(alpha, 0.0, 1.0);
  return weight * std::sqrt((slopes * across).squaredNorm() / 3);
}

void CellMesh::link_twins() {
  const QuadMesh& mesh = layer_.mesh();
  // Edges are told by their number, lines within a patch by the patch, sides by where they run.
  using Key = std::tuple<int, double, double, double, double>;
  std::map<Key, int> found;
  for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
    Side& side = sides_[s];
    const int q = quad(side.cell), h = 4 * q + side.k;
    Key key, reversed;
    if (side.on_border) {
      side.beyond = beyond(q, side.k);
      const int axis = is_along_u(side.k) ? 0 : 1;
      const bool with_edge = (mesh.halfedge(mesh.edge(h)) == h) == (side.k < 2);
      const double from = with_edge ? side.from[axis] : 1 - side.from[axis];
      const double to = with_edge ? side.to[axis] : 1 - side.to[axis];
      key = {-1 - mesh.edge(h), from, to, 0, 0};
      reversed = {-1 - mesh.edge(h), to, from, 0, 0};
      side.is_torn = mesh.is_tear(mesh.edge(h));
    } else {
      key = {q, side.from.x(), side.from.y(), side.to.x(), side.to.y()};
      reversed = {q, side.to.x(), side.to.y(), side.from.x(), side.from.y()};
    }
    const auto other = found.find(reversed);
    if (other == found.end()) {
      found.emplace(key, s);
    } else {
      side.twin = other->second;
      sides_[other->second].twin = s;
      found.erase(other);
    }
  }
}

/// True where nothing is painted beyond: the mask of translucent colours ends there.
bool CellMesh::is_outline(int h) const {
  const int twin = layer_.mesh().twin(h);
  return twin < 0 || layer_.opacity(QuadMesh::quad_of(twin)) == PatchOpacity::transparent;
}

bool CellMesh::is_hidden_in(int quad, int other) const {
  const bool is_over = paint_ == CellPaint::color && layer_.is_outshone(other, quad);
  return layer_.is_painted_later(quad, other) || is_over;
}

CellMesh::Beyond CellMesh::beyond(int quad, int k) const {
  const int h = 4 * quad + k;
  const bool is_clipped =
      layer_.is_opaque(quad) ? layer_.is_clipped(h) : paint_ == CellPaint::color && is_outline(h);
  if (is_clipped) return Beyond::clip;
  const int twin = layer_.mesh().twin(h);
  if (twin >= 0 && is_hidden_in(quad, QuadMesh::quad_of(twin))) return Beyond::later;
  const bool is_smooth = !layer_.is_border(h) && !layer_.mesh().is_tear(layer_.mesh().edge(h));
  return is_smooth ? Beyond::seam : Beyond::nothing;
}

}  // namespace quadrille
