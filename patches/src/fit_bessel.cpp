#include "fit_bessel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <optional>

#include "edge_ends.h"
#include "parallel_ranges.h"
#include "picture_sampling.h"
#include "wedge_corners.h"

namespace quadrille {
namespace {

/// Change of position and colour per pixel of arc length.
template <class C>
struct Slope {
  Eigen::Vector2d position;
  C color;
};

/// A sum of samples with weights.
class Combination {
 public:
  Combination() = default;
  explicit Combination(int sample) : weights_{{sample, 1.0}} {}

  const std::map<int, double>& weights() const { return weights_; }
  Combination operator+(const Combination& other) const {
    Combination sum = *this;
    for (const auto& [sample, weight] : other.weights_) sum.weights_[sample] += weight;
    return sum;
  }
  Combination operator-(const Combination& other) const { return *this + other * -1; }
  Combination operator*(double factor) const {
    Combination product = *this;
    for (auto& [sample, weight] : product.weights_) weight *= factor;
    return product;
  }
  Combination operator/(double divisor) const { return *this * (1 / divisor); }

 private:
  std::map<int, double> weights_;
};

/// A tear is seen through the pixels' box and the tent of bilinear sampling, together up to 2.1
/// pixels wide to either side; beyond, a sample has the colour of its own side.
constexpr double kTornInset = 2;
/// As a share of the way to the middle of the wedge's quads, where other wedges' samples may lie.
constexpr double kMostInset = 2.0 / 3;

/// Where the picture is sampled for each wedge.
class SamplePoints {
 public:
  SamplePoints(const PatchMesh& patches, const WedgeCorners& corners)
      : patches_(patches), corners_(corners), points_(patches.wedges.size()) {
    for_each_range(static_cast<int>(points_.size()), [&](int begin, int end) {
      for (int w = begin; w < end; ++w) points_[w] = sample_point(w);
    });
  }

  const Eigen::Vector2d& operator[](int w) const { return points_[w]; }
  const Eigen::Vector2d& vertex(int w) const { return patches_.mesh.vertices[vertex_of(w)]; }

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
    return p + inward * std::min(kMostInset, kTornInset / std::max(distance, 1e-300));
  }

  const PatchMesh& patches_;
  const WedgeCorners& corners_;
  std::vector<Eigen::Vector2d> points_;
};

/// The Bessel scheme over samples of any kind that can be added up.
template <class C>
class BesselScheme {
 public:
  struct Result {
    C value, dx, dy;
  };

  BesselScheme(const PatchMesh& patches, const WedgeCorners& corners, const SamplePoints& points,
               const std::vector<C>& colors)
      : patches_(patches),
        corners_(corners),
        points_(points),
        colors_(colors),
        opposite_(opposite_ends(patches.mesh)) {}

  Result wedge(int w) const {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    C right_x = colors_[w] * 0, right_y = right_x;
    for_each_end(w, [&](int end, int neighbour) {
      const Slope<C> s = slope(w, end, neighbour);
      normal += s.position * s.position.transpose();
      right_x = right_x + s.color * s.position.x();
      right_y = right_y + s.color * s.position.y();
    });
    // A vanishing ridge keeps corners of almost parallel sides defined.
    normal.diagonal().array() += 1e-12 * normal.trace() + 1e-300;
    const Eigen::Matrix2d inverse = normal.inverse();
    const Eigen::Vector2d back = points_.vertex(w) - points_[w];
    Result result;
    result.dx = right_x * inverse(0, 0) + right_y * inverse(0, 1);
    result.dy = right_x * inverse(1, 0) + right_y * inverse(1, 1);
    result.value = colors_[w] + (result.dx * back.x() + result.dy * back.y());
    return result;
  }

 private:
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

  Slope<C> chord(int from, int to) const {
    const Eigen::Vector2d step = points_[to] - points_[from];
    const double length = std::max(step.norm(), 1e-300);
    return {step / length, (colors_[to] - colors_[from]) / length};
  }

  /// Slope at the middle of the parabola through three samples with chord-length parameters.
  Slope<C> parabola(int before, int middle, int after) const {
    const double a = (points_[middle] - points_[before]).norm();
    const double b = (points_[after] - points_[middle]).norm();
    const Slope<C> in = chord(before, middle), out = chord(middle, after);
    const double t = a + b > 0 ? b / (a + b) : 0.5;
    return {in.position * t + out.position * (1 - t), in.color * t + out.color * (1 - t)};
  }

  Slope<C> slope(int w, int end, int neighbour) const {
    if (const auto before = continuation(w, end)) return parabola(*before, w, neighbour);
    const Slope<C> whole = chord(w, neighbour);
    const auto beyond = continuation(neighbour, end ^ 1);
    if (!beyond) return whole;
    // The mean of a parabola's end slopes is its chord's.
    const Slope<C> far = parabola(w, neighbour, *beyond);
    return {2 * whole.position - far.position, whole.color * 2 - far.color};
  }

  const PatchMesh& patches_;
  const WedgeCorners& corners_;
  const SamplePoints& points_;
  const std::vector<C>& colors_;
  std::vector<int> opposite_;
};

}  // namespace

std::vector<Wedge> bessel_wedges(const PatchMesh& patches, const Raster& picture) {
  const int count = static_cast<int>(patches.wedges.size());
  const WedgeCorners corners(patches);
  const SamplePoints points(patches, corners);
  std::vector<Eigen::Array4d> colors(count);
  for_each_range(count, [&](int begin, int end) {
    for (int w = begin; w < end; ++w) colors[w] = sample_bilinear(picture, points[w]);
  });
  const BesselScheme<Eigen::Array4d> scheme(patches, corners, points, colors);
  std::vector<Wedge> wedges(count);
  for_each_range(count, [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      const auto result = scheme.wedge(w);
      wedges[w].value = result.value.cast<float>();
      wedges[w].dx = result.dx.cast<float>();
      wedges[w].dy = result.dy.cast<float>();
      if (picture.has_alpha()) continue;
      wedges[w].value.w() = 1;
      wedges[w].dx.w() = wedges[w].dy.w() = 0;
    }
  });
  return wedges;
}

std::vector<std::vector<BesselTerm>> bessel_terms(const PatchMesh& patches) {
  const int count = static_cast<int>(patches.wedges.size());
  const WedgeCorners corners(patches);
  const SamplePoints points(patches, corners);
  std::vector<Combination> samples;
  for (int w = 0; w < count; ++w) samples.emplace_back(w);
  const BesselScheme<Combination> scheme(patches, corners, points, samples);
  std::vector<std::vector<BesselTerm>> terms(count);
  for_each_range(count, [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      const auto result = scheme.wedge(w);
      // All three combine the same samples: the wedge's own and those the slopes reach.
      auto dx = result.dx.weights().begin(), dy = result.dy.weights().begin();
      for (const auto& [sample, weight] : result.value.weights()) {
        terms[w].push_back(
            {sample, Eigen::Vector3d(weight, (dx++)->second, (dy++)->second).cast<float>()});
      }
    }
  });
  return terms;
}

}  // namespace quadrille
