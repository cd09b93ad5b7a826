#include "gltf_divisions.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

#include "gltf_color.h"
#include "gltf_pattern.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr int kMostSegments = 64;
constexpr int kMostForContent = 16;
constexpr int kMostForOrientation = 32;
constexpr long long kMostCells = 1ll << 26;

using ColorCurve = std::array<Color, 4>;

int segments_for_shape(const PlaneCurve& curve, double tolerance) {
  for (int n = 1; n < kMostSegments; n += (n + 3) / 4) {
    bool fits = true;
    for (int k = 0; k < n && fits; ++k) {
      fits = chord_distance(sub_curve(curve, double(k) / n, double(k + 1) / n)) <= tolerance;
    }
    if (fits) return n;
  }
  return kMostSegments;
}

/// The colour of a vertex, about in linear light: a gamma of 2 instead of sRGB's curve.
Color about_linear(const Color& premultiplied) {
  Color color = straight_color(premultiplied);
  color.head<3>() = color.head<3>().square();
  return color;
}

/// What is seen of a vertex colour, premultiplied.
Color as_seen(Color linear) {
  linear.head<3>() = linear.head<3>().sqrt() * linear[3];
  return linear;
}

/// Judges polylines along curves of colour.
class ContentJudge {
 public:
  explicit ContentJudge(const SurfaceContent& content) : content_(content) {}

  bool is_needed() const { return content_.has_colors || content_.relief != 0; }

  int segments(const ColorCurve& curve) const {
    for (const int n : {1, 2, 3, 4, 6, 8, 12}) {
      if (fits(curve, n)) return n;
    }
    return kMostForContent;
  }

 private:
  bool fits(const ColorCurve& curve, int n) const {
    constexpr int kPerPart = 4;
    const BicubicBezier<Color> strip{{curve, curve, curve, curve}};
    Color left = strip.at(0, 0);
    for (int i = 0; i < n; ++i) {
      const Color right = strip.at(double(i + 1) / n, 0);
      for (int k = 1; k < kPerPart; ++k) {
        const float f = float(k) / kPerPart;
        if (!fits(left, right, f, strip.at((i + f) / double(n), 0))) return false;
      }
      left = right;
    }
    return true;
  }

  bool fits(const Color& left, const Color& right, float f, const Color& truth) const {
    const double height = luma(left) * (1 - f) + luma(right) * f;
    if (std::abs(content_.relief * (height - luma(truth))) > kHeightTolerance) return false;
    if (!content_.has_colors) return true;
    const Color seen = as_seen(about_linear(left) * (1 - f) + about_linear(right) * f);
    const Color wished = straight_color(truth);
    Color premultiplied = wished;
    premultiplied.head<3>() *= wished[3];
    return (seen - premultiplied).abs().maxCoeff() <= kColorTolerance;
  }

  const SurfaceContent& content_;
};

/// The colour along the line v = t (or u = t) of a patch.
ColorCurve color_line(const BicubicBezier<Color>& color, bool along_u, double t) {
  ColorCurve curve;
  for (int i = 0; i < 4; ++i) {
    ColorCurve across;
    for (int j = 0; j < 4; ++j) across[j] = along_u ? color.control[j][i] : color.control[i][j];
    curve[i] = sub_curve(across, t, t)[0];
  }
  return curve;
}

class Divider {
 public:
  Divider(const SheetedLayer& layer, const SurfaceContent& content)
      : layer_(layer), mesh_(layer.mesh()), judge_(content) {
    out_.edges.assign(mesh_.edge_count(), 1);
    out_.patches.assign(mesh_.quad_count(), {1, 1});
  }

  SurfaceDivisions run(const RunContext& context) {
    const double inner = judge_.is_needed() ? kInnerTolerance : kTexturedTolerance;
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      const bool is_contour = layer_.is_contour(mesh_.halfedge(e));
      out_.edges[e] =
          segments_for_shape(layer_.edge_curve(e), is_contour ? kContourTolerance : inner);
    }
    context.progress("surface", 0.2);
    if (judge_.is_needed()) divide_for_content(context);
    turn_to_front();
    check_size();
    return std::move(out_);
  }

 private:
  void divide_for_content(const RunContext& context) {
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (q % 8192 == 0) context.progress("surface", 0.2 + 0.4 * q / mesh_.quad_count());
      if (!layer_.is_drawn(q)) continue;
      const BicubicBezier<Color>& color = layer_.color(q);
      for (int direction = 0; direction < 2; ++direction) {
        int& inner = out_.patches[q][direction];
        for (const double t : {0.25, 0.5, 0.75}) {
          inner = std::max(inner, judge_.segments(color_line(color, direction == 0, t)));
        }
        for (int side = direction; side < 4; side += 2) {
          int& n = out_.edges[mesh_.edge(4 * q + side)];
          const double t = side == 0 || side == 3 ? 0 : 1;
          n = std::max(n, judge_.segments(color_line(color, direction == 0, t)));
        }
      }
    }
  }

  /// The least grid for the sides as they are.
  void fit_grid(int q) {
    auto& grid = out_.patches[q];
    for (int side = 0; side < 4; ++side) {
      grid[side % 2] = std::max(grid[side % 2], out_.edges[mesh_.edge(4 * q + side)]);
    }
    // A single row cannot hold the transitions to two unlike sides.
    for (int round = 0; round < 2; ++round) {
      for (int direction = 0; direction < 2; ++direction) {
        int& across = grid[1 - direction];
        const int n = grid[direction], low = out_.edges[mesh_.edge(4 * q + direction)],
                  high = out_.edges[mesh_.edge(4 * q + direction + 2)];
        if (across == 1 && low != n && high != n) across = 2;
      }
    }
  }

  bool faces_front(int q) {
    fit_grid(q);
    const PatchPattern pattern(sides(q), out_.patches[q]);
    const PatchPoints points = patch_points(layer_, q, pattern);
    PolygonCutter cutter(layer_.layer().transform.linear().determinant() < 0);
    for (const Polygon& polygon : pattern.polygons()) {
      if (!cutter.cut(polygon, points).faces_front) return false;
    }
    return true;
  }

  std::array<int, 4> sides(int q) const {
    std::array<int, 4> n;
    for (int side = 0; side < 4; ++side) n[side] = out_.edges[mesh_.edge(4 * q + side)];
    return n;
  }

  /// Divides the sides of patches with turned triangles, until there are none. The work list keeps
  /// its order, so the result is the same whatever happens elsewhere.
  void turn_to_front() {
    std::deque<int> open;
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (layer_.is_drawn(q)) open.push_back(q);
    }
    while (!open.empty()) {
      const int q = open.front();
      open.pop_front();
      if (faces_front(q)) continue;
      bool is_finer = false;
      for (int h = 4 * q; h < 4 * q + 4; ++h) {
        int& n = out_.edges[mesh_.edge(h)];
        if (n >= kMostForOrientation) continue;
        n = std::min(2 * n, kMostForOrientation);
        is_finer = true;
        const int twin = mesh_.twin(h);
        if (twin >= 0 && layer_.is_drawn(QuadMesh::quad_of(twin))) {
          open.push_back(QuadMesh::quad_of(twin));
        }
      }
      if (is_finer) open.push_back(q);
    }
  }

  void check_size() const {
    long long cells = 0;
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (layer_.is_drawn(q)) cells += 1ll * out_.patches[q][0] * out_.patches[q][1];
    }
    if (cells <= kMostCells) return;
    throw Error(ErrorCode::limit_exceeded,
                "layer '" + layer_.layer().name + "' takes " + std::to_string(cells) +
                    " cells to stay within the tolerances of glTF export; scale it down");
  }

  const SheetedLayer& layer_;
  const QuadMesh& mesh_;
  ContentJudge judge_;
  SurfaceDivisions out_;
};

}  // namespace

SurfaceDivisions divide(const SheetedLayer& layer, const SurfaceContent& content,
                        const RunContext& context) {
  return Divider(layer, content).run(context);
}

}  // namespace quadrille
