#include "gltf_pattern.h"

#include <algorithm>
#include <cmath>

namespace quadrille {
namespace {

Eigen::Vector2d curve_point(const PlaneCurve& b, double t) {
  const double s = 1 - t;
  return b[0] * (s * s * s) + b[1] * (3 * s * s * t) + b[2] * (3 * s * t * t) + b[3] * (t * t * t);
}

/// Twice the area, positive when counter-clockwise with y up.
double area(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
  const Eigen::Vector2d p = (b - a).cast<double>(), q = (c - a).cast<double>();
  return p.y() * q.x() - p.x() * q.y();
}

}  // namespace

PatchPattern::PatchPattern(const std::array<int, 4>& segments, const std::array<int, 2>& grid)
    : segments_(segments), columns_(grid[0]), rows_(grid[1]) {
  int begin = 0;
  for (int side = 0; side < 4; ++side) {
    side_begin_[side] = begin;
    begin += segments_[side];
  }
  inner_begin_ = begin;
  i0_ = is_regular(3) ? 0 : 1;
  i1_ = is_regular(1) ? columns_ : columns_ - 1;
  j0_ = is_regular(0) ? 0 : 1;
  j1_ = is_regular(2) ? rows_ : rows_ - 1;
  polygons_.reserve(columns_ * rows_ + 4);
  for (int j = j0_; j < j1_; ++j) {
    for (int i = i0_; i < i1_; ++i) {
      polygons_.push_back(
          {on_grid(i, j), on_grid(i + 1, j), on_grid(i + 1, j + 1), on_grid(i, j + 1)});
    }
  }
  for (int side = 0; side < 4; ++side) {
    if (!is_regular(side)) add_strip(side);
  }
}

int PatchPattern::on_side(int side, int i) const {
  return i == segments_[side] ? side_begin_[(side + 1) % 4] : side_begin_[side] + i;
}

int PatchPattern::on_grid(int i, int j) const {
  if (j == 0) return on_side(0, i);
  if (j == rows_) return on_side(2, columns_ - i);
  if (i == columns_) return on_side(1, j);
  if (i == 0) return on_side(3, rows_ - j);
  return inner_begin_ + (j - 1) * (columns_ - 1) + i - 1;
}

/// Between the vertices of a side and the nearest row of the grid.
void PatchPattern::add_strip(int side) {
  const int n = side % 2 == 0 ? columns_ : rows_, m = segments_[side];
  const int first = side % 2 == 0 ? i0_ : j0_, last = side % 2 == 0 ? i1_ : j1_;
  const bool is_backward = side >= 2;
  const int count = last - first;
  const auto parameter = [&](int b) { return is_backward ? n - (last - b) : first + b; };  // / n
  const auto inner = [&](int b) {
    const int at = is_backward ? last - b : first + b;
    switch (side) {
      case 0:
        return on_grid(at, 1);
      case 1:
        return on_grid(columns_ - 1, at);
      case 2:
        return on_grid(at, rows_ - 1);
      default:
        return on_grid(1, at);
    }
  };
  for (int a = 0, b = 0; a < m || b < count;) {
    const bool can_both =
        a < m && b < count && a * n == parameter(b) * m && (a + 1) * n == parameter(b + 1) * m;
    if (can_both) {
      polygons_.push_back({on_side(side, a), on_side(side, a + 1), inner(b + 1), inner(b)});
      ++a, ++b;
    } else if (b == count || (a < m && (2 * a + 1) * n <= (parameter(b) + parameter(b + 1)) * m)) {
      polygons_.push_back({on_side(side, a), on_side(side, a + 1), inner(b), -1});
      ++a;
    } else {
      polygons_.push_back({on_side(side, a), inner(b + 1), inner(b), -1});
      ++b;
    }
  }
}

PatchPoints patch_points(const SheetedLayer& layer, int quad, const PatchPattern& pattern) {
  const QuadMesh& mesh = layer.mesh();
  PatchPoints points;
  points.reserve(pattern.vertex_count());
  for (int side = 0; side < 4; ++side) {
    const int h = 4 * quad + side, e = mesh.edge(h), n = pattern.segments(side);
    const PlaneCurve curve = layer.edge_curve(e);
    for (int i = 0; i < n; ++i) {
      // The same sum for both patches beside the edge.
      const int k = mesh.halfedge(e) == h ? i : n - i;
      const Eigen::Vector2d p = i == 0 ? layer.layer().transform * mesh.vertices[mesh.origin(h)]
                                       : curve_point(curve, double(k) / n);
      points.push_back(p.cast<float>());
    }
  }
  for (int j = 1; j < pattern.rows(); ++j) {
    for (int i = 1; i < pattern.columns(); ++i) {
      const Eigen::Vector2d p =
          layer.position(quad).at(double(i) / pattern.columns(), double(j) / pattern.rows());
      points.push_back(p.cast<float>());
    }
  }
  return points;
}

CutPolygon PolygonCutter::cut(const Polygon& polygon, const PatchPoints& points,
                              int previous_first) const {
  Polygon p = polygon;
  const int n = p[3] < 0 ? 3 : 4;
  if (!is_mirrored_) std::reverse(p.begin(), p.begin() + n);
  int start = 0;
  if (n == 4) {
    const auto least_area = [&](int s) {
      const auto at = [&](int k) -> const Eigen::Vector2f& { return points[p[(s + k) % 4]]; };
      return std::min(area(at(0), at(1), at(2)), area(at(0), at(2), at(3)));
    };
    const double even = least_area(0), odd = least_area(1);
    const bool is_odd_shorter =
        (points[p[3]] - points[p[1]]).norm() < (points[p[2]] - points[p[0]]).norm();
    if (even > 0 && odd > 0) {
      start = is_odd_shorter ? 1 : 0;
    } else {
      start = odd > even ? 1 : 0;
    }
  }
  if (p[start] == previous_first) start = n == 4 ? start + 2 : 1;
  CutPolygon cut;
  cut.count = 3 * (n - 2);
  for (int t = 0; t < n - 2; ++t) {
    const std::array<int, 3> triangle = {p[start % n], p[(start + t + 1) % n],
                                         p[(start + t + 2) % n]};
    std::copy(triangle.begin(), triangle.end(), cut.triangles.begin() + 3 * t);
    cut.faces_front &= area(points[triangle[0]], points[triangle[1]], points[triangle[2]]) > 0;
  }
  return cut;
}

}  // namespace quadrille
