#include "fit_bessel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <optional>

#include "edge_ends.h"
#include "parallel_ranges.h"
#include "picture_sampling.h"
#include "wedge_corners.h"

namespace quadrille {
namespace {

/// A sample of the picture that stands for a wedge.
struct Sample {
  Eigen::Vector2d point;
  Eigen::Array4d color;
};

/// Change of position and colour per pixel of arc length.
struct Slope {
  Eigen::Vector2d position;
  Eigen::Array4d color;
};

/// A tear is seen through the pixels' box and the tent of bilinear sampling, together up to 2.1
/// pixels wide to either side; beyond, a sample has the colour of its own side.
constexpr double kTornInset = 2;

class BesselColors {
 public:
  BesselColors(const PatchMesh& patches, const Raster& picture)
      : patches_(patches), corners_(patches), opposite_(opposite_ends(patches.mesh)) {
    samples_.resize(patches.wedges.size());
    for_each_range(wedge_count(), [&](int begin, int end) {
      for (int w = begin; w < end; ++w) {
        const Eigen::Vector2d p = sample_point(w);
        samples_[w] = {p, sample_bilinear(picture, p)};
      }
    });
  }

  int wedge_count() const { return static_cast<int>(patches_.wedges.size()); }

  Wedge wedge(int w) const {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, 4> right = Eigen::Matrix<double, 2, 4>::Zero();
    for_each_end(w, [&](int end, int neighbour) {
      const Slope s = slope(w, end, neighbour);
      normal += s.position * s.position.transpose();
      right += s.position * s.color.matrix().transpose();
    });
    // A vanishing ridge keeps corners of almost parallel sides defined.
    normal.diagonal().array() += 1e-12 * normal.trace() + 1e-300;
    const Eigen::Matrix<double, 2, 4> gradient = normal.inverse() * right;
    const Eigen::Vector2d back = patches_.mesh.vertices[vertex_of(w)] - samples_[w].point;
    Wedge result;
    result.value =
        (samples_[w].color + (gradient.transpose() * back).array()).template cast<float>();
    result.dx = gradient.row(0).transpose().array().cast<float>();
    result.dy = gradient.row(1).transpose().array().cast<float>();
    return result;
  }

 private:
  int vertex_of(int w) const { return patches_.mesh.origin(corners_[w].front()); }

  /// The vertex, or for a torn one a point toward the middle of the wedge's quads that keeps its
  /// distance from the tears.
  Eigen::Vector2d sample_point(int w) const {
    const QuadMesh& mesh = patches_.mesh;
    const int v = vertex_of(w);
    const Eigen::Vector2d p = mesh.vertices[v];
    if (corners_[w].size() == mesh.fan(v).size()) return p;
    Eigen::Vector2d inward = Eigen::Vector2d::Zero();
    for (const int h : corners_[w]) {
      for (const int c : mesh.quads()[QuadMesh::quad_of(h)])
        inward += 0.25 * (mesh.vertices[c] - p);
    }
    inward /= static_cast<double>(corners_[w].size());
    const double length = inward.norm();
    if (!(length > 0)) return p;
    double distance = length;  // of the middle from the lines of the tears
    const auto keep_off = [&](int h, int other) {
      if (!mesh.is_tear(mesh.edge(h))) return;
      const Eigen::Vector2d along = (mesh.vertices[other] - p).normalized();
      if (along.dot(inward) < 0) return;
      distance = std::min(distance, std::abs(along.x() * inward.y() - along.y() * inward.x()));
    };
    for (const int h : corners_[w]) {
      keep_off(h, mesh.tip(h));
      keep_off(QuadMesh::prev(h), mesh.origin(QuadMesh::prev(h)));
    }
    return p + inward * std::min(1.0, kTornInset / std::max(distance, 1e-300));
  }

  /// Calls visit(end, neighbour) for both sides of every corner of the wedge: the edge end at the
  /// wedge's vertex and the wedge that the corner's quad has at the other end.
  template <class Visit>
  void for_each_end(int w, const Visit& visit) const {
    for (const int h : corners_[w]) {
      visit(edge_end(patches_.mesh, h, 0), patches_.wedge_of_corner[QuadMesh::next(h)]);
      const int before = QuadMesh::prev(h);
      visit(edge_end(patches_.mesh, before, 1), patches_.wedge_of_corner[before]);
    }
  }

  /// The wedge at the other side of the edge that continues `end` through wedge w, if w touches it.
  std::optional<int> continuation(int w, int end) const {
    std::optional<int> found;
    if (opposite_[end] < 0) return found;
    for_each_end(w, [&](int e, int neighbour) {
      if (e == opposite_[end] && !found) found = neighbour;
    });
    return found;
  }

  Slope chord(int from, int to) const {
    const Eigen::Vector2d step = samples_[to].point - samples_[from].point;
    const double length = std::max(step.norm(), 1e-300);
    return {step / length, (samples_[to].color - samples_[from].color) / length};
  }

  /// Slope at the middle of the parabola through three samples with chord-length parameters.
  Slope parabola(int before, int middle, int after) const {
    const double a = (samples_[middle].point - samples_[before].point).norm();
    const double b = (samples_[after].point - samples_[middle].point).norm();
    const Slope in = chord(before, middle), out = chord(middle, after);
    const double t = a + b > 0 ? b / (a + b) : 0.5;
    return {in.position * t + out.position * (1 - t), in.color * t + out.color * (1 - t)};
  }

  Slope slope(int w, int end, int neighbour) const {
    if (const auto before = continuation(w, end)) return parabola(*before, w, neighbour);
    const Slope whole = chord(w, neighbour);
    const auto beyond = continuation(neighbour, end ^ 1);
    if (!beyond) return whole;
    // The mean of a parabola's end slopes is its chord's.
    const Slope far = parabola(w, neighbour, *beyond);
    return {2 * whole.position - far.position, 2 * whole.color - far.color};
  }

  const PatchMesh& patches_;
  WedgeCorners corners_;
  std::vector<int> opposite_;
  std::vector<Sample> samples_;
};

}  // namespace

std::vector<Wedge> bessel_wedges(const PatchMesh& patches, const Raster& picture) {
  const BesselColors colors(patches, picture);
  std::vector<Wedge> wedges(patches.wedges.size());
  for_each_range(colors.wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      wedges[w] = colors.wedge(w);
      if (picture.has_alpha()) continue;
      wedges[w].value.w() = 1;
      wedges[w].dx.w() = wedges[w].dy.w() = 0;
    }
  });
  return wedges;
}

}  // namespace quadrille
