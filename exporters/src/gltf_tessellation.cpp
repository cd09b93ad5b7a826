#include "gltf_tessellation.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "quadrille/bicubic.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr int kMaxSegments = 64;

/// The edge's curve along mesh.halfedge(e) in Bezier form, in picture coordinates.
std::array<Vector2d, 4> edge_curve(const Layer& layer, int e) {
  const QuadMesh& mesh = layer.patches.mesh;
  const int h = mesh.halfedge(e);
  const Vector2d from = mesh.vertices[mesh.origin(h)], to = mesh.vertices[mesh.tip(h)];
  const auto& tangents = layer.patches.edge_tangents[e];
  return {layer.transform * from, layer.transform * (from + tangents[0] / 3),
          layer.transform * (to - tangents[1] / 3), layer.transform * to};
}

Vector2d curve_point(const std::array<Vector2d, 4>& b, double t) {
  const double s = 1 - t;
  return b[0] * (s * s * s) + b[1] * (3 * s * s * t) + b[2] * (3 * s * t * t) + b[3] * (t * t * t);
}

/// Uniform segments that keep the chords within the tolerance: a curve C leaves its chord over a
/// parameter step d by at most d^2 max|C''| / 8, and |C''| <= 6 max|second difference|.
int segments_needed(const std::array<Vector2d, 4>& b, double tolerance) {
  const Vector2d chord = b[3] - b[0];
  const auto off_chord = [&](const Vector2d& p) {
    const Vector2d d = p - b[0];
    return std::abs(chord.x() * d.y() - chord.y() * d.x());
  };
  const double straight = 1e-9 * chord.squaredNorm();
  if (off_chord(b[1]) <= straight && off_chord(b[2]) <= straight) return 1;
  const double bend = std::max((b[0] - 2 * b[1] + b[2]).norm(), (b[1] - 2 * b[2] + b[3]).norm());
  const double segments = std::ceil(std::sqrt(0.75 * bend / tolerance));
  return static_cast<int>(std::clamp(segments, 1.0, double(kMaxSegments)));
}

class Tessellator {
 public:
  Tessellator(const Layer& layer, double picture_height)
      : layer_(layer),
        mesh_(layer.patches.mesh),
        height_(picture_height),
        mirrored_(layer.transform.linear().determinant() < 0) {
    segments_.reserve(mesh_.edge_count());
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      const double tolerance = mesh_.is_border(e) ? kOutlineTolerance : kInnerTolerance;
      segments_.push_back(segments_needed(edge_curve(layer, e), tolerance));
    }
  }

  /// Chords of a coarsely divided, strongly curved edge may cut through the rows of vertices inside
  /// the patch; dividing finer makes every triangle of a fold-free patch face the front.
  TriangleMesh run() {
    while (true) {
      const std::vector<int> turned = build();
      bool refined = false;
      for (const int q : turned) refined |= refine(q);
      if (!refined) return std::move(out_);
    }
  }

 private:
  /// Fills out_ at the current division; returns the patches that have a triangle facing away.
  std::vector<int> build() {
    out_ = {};
    for (const Vector2d& p : mesh_.vertices) add_vertex(layer_.transform * p);
    inner_begin_.clear();
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      inner_begin_.push_back(static_cast<std::uint32_t>(out_.positions.size()));
      const auto curve = edge_curve(layer_, e);
      for (int k = 1; k < segments_[e]; ++k) {
        add_vertex(curve_point(curve, double(k) / segments_[e]));
      }
    }
    std::vector<int> turned;
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (!add_patch(q)) turned.push_back(q);
    }
    return turned;
  }

  bool refine(int q) {
    bool refined = false;
    for (int h = 4 * q; h < 4 * q + 4; ++h) {
      int& n = segments_[mesh_.edge(h)];
      refined |= n < kMaxSegments;
      n = std::min(2 * n, kMaxSegments);
    }
    return refined;
  }

  std::uint32_t add_vertex(const Vector2d& p) {
    out_.positions.push_back({static_cast<float>(p.x()), static_cast<float>(height_ - p.y())});
    return static_cast<std::uint32_t>(out_.positions.size() - 1);
  }

  /// Takes corners in the order of a patch's own, which y up turns around.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!mirrored_) std::swap(b, c);
    out_.indices.insert(out_.indices.end(), {a, b, c});
    const auto &p = out_.positions[a], &q = out_.positions[b], &r = out_.positions[c];
    const double area = (double(q[0]) - p[0]) * (double(r[1]) - p[1]) -
                        (double(q[1]) - p[1]) * (double(r[0]) - p[0]);
    all_front_ &= area > 0;
  }

  /// The vertices along half-edge h, both ends included.
  std::vector<std::uint32_t> side(int h) const {
    const int e = mesh_.edge(h), n = segments_[e];
    std::vector<std::uint32_t> ids = {static_cast<std::uint32_t>(mesh_.origin(h))};
    for (int k = 1; k < n; ++k) {
      ids.push_back(inner_begin_[e] + (mesh_.halfedge(e) == h ? k - 1 : n - 1 - k));
    }
    ids.push_back(static_cast<std::uint32_t>(mesh_.tip(h)));
    return ids;
  }

  bool add_patch(int q) {
    all_front_ = true;
    int n = 1;
    for (int h = 4 * q; h < 4 * q + 4; ++h) n = std::max(n, segments_[mesh_.edge(h)]);
    if (n == 1) {
      add_quad(q);
    } else {
      add_grid(q, n);
    }
    return all_front_;
  }

  void add_quad(int q) {
    const QuadMesh::Quad& c = mesh_.quads()[q];
    const auto& v = mesh_.vertices;
    const bool first_diagonal = (v[c[2]] - v[c[0]]).norm() <= (v[c[3]] - v[c[1]]).norm();
    const int s = first_diagonal ? 0 : 1;
    add_triangle(c[s], c[s + 1], c[s + 2]);
    add_triangle(c[s], c[s + 2], c[(s + 3) % 4]);
  }

  /// (n - 1) x (n - 1) vertices inside the patch, joined to the vertices of each side.
  void add_grid(int q, int n) {
    const auto position = to_bezier(patch_geometry(layer_.patches, q));
    const auto first = static_cast<std::uint32_t>(out_.positions.size());
    for (int j = 1; j < n; ++j) {
      for (int i = 1; i < n; ++i) {
        add_vertex(layer_.transform * position.at(double(i) / n, double(j) / n));
      }
    }
    const int last = n - 2;
    const auto grid = [&](int i, int j) { return first + j * (n - 1) + i; };
    for (int j = 0; j < last; ++j) {
      for (int i = 0; i < last; ++i) {
        add_triangle(grid(i, j), grid(i + 1, j), grid(i + 1, j + 1));
        add_triangle(grid(i, j), grid(i + 1, j + 1), grid(i, j + 1));
      }
    }
    std::array<std::vector<std::uint32_t>, 4> inner;
    for (int k = 0; k <= last; ++k) {
      inner[0].push_back(grid(k, 0));
      inner[1].push_back(grid(last, k));
      inner[2].push_back(grid(last - k, last));
      inner[3].push_back(grid(0, last - k));
    }
    for (int k = 0; k < 4; ++k) add_strip(side(4 * q + k), inner[k], n);
  }

  /// Triangles between a side and the nearest row of inner vertices, which lie at the parameters
  /// 1/n, 2/n, ... of the side.
  void add_strip(const std::vector<std::uint32_t>& outer, const std::vector<std::uint32_t>& inner,
                 int n) {
    std::size_t a = 0, b = 0;
    const double segments = double(outer.size() - 1);
    while (a + 1 < outer.size() || b + 1 < inner.size()) {
      const bool outer_next =
          b + 1 == inner.size() || (a + 1 < outer.size() && (a + 0.5) / segments <= (b + 1.5) / n);
      if (outer_next) {
        add_triangle(outer[a], outer[a + 1], inner[b]);
        ++a;
      } else {
        add_triangle(outer[a], inner[b + 1], inner[b]);
        ++b;
      }
    }
  }

  const Layer& layer_;
  const QuadMesh& mesh_;
  double height_;
  bool mirrored_;
  std::vector<int> segments_;               // #E
  std::vector<std::uint32_t> inner_begin_;  // #E, first vertex inside the edge
  TriangleMesh out_;
  bool all_front_ = true;
};

}  // namespace

TriangleMesh tessellate(const Layer& layer, double picture_height) {
  return Tessellator(layer, picture_height).run();
}

}  // namespace quadrille
