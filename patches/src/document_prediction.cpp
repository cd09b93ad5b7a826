#include "document_prediction.h"

namespace quadrille {
namespace {

/// Calls visit(half-edge of the neighbouring corner) for both ends of a corner's sides.
template <class Visit>
void for_each_side(int corner, const Visit& visit) {
  visit(QuadMesh::next(corner));
  visit(QuadMesh::prev(corner));
}

double dot(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.x() + a.y() * b.y();
}

/// Of the neighbours in a fit of the gradient: near ones weigh more.
double weight_of(const Eigen::Vector2d& difference) { return 1 / dot(difference, difference); }

}  // namespace

ChannelPredictor::ChannelPredictor(const PatchMesh& patches, const std::vector<ColorFrame>& frames)
    : patches_(patches), frames_(frames), corners_(patches) {
  const QuadMesh& mesh = patches.mesh;
  const int count = static_cast<int>(patches.wedges.size());
  for (int q = 0; q < mesh.quad_count(); ++q) geometry_.push_back(patch_geometry(patches, q));
  slope_of_.resize(count);
  for (int w = 0; w < count; ++w) {
    const Eigen::Vector2d p = mesh.vertices[vertex_of(w)];
    double xx = 0, xy = 0, yy = 0;
    for (const int h : corners_[w]) {
      for_each_side(h, [&](int g) {
        const Eigen::Vector2d d = mesh.vertices[mesh.origin(g)] - p;
        if (d.x() == 0 && d.y() == 0) return;
        const double weight = weight_of(d);
        xx += weight * d.x() * d.x();
        xy += weight * d.x() * d.y();
        yy += weight * d.y() * d.y();
      });
    }
    xx += 1e-3, yy += 1e-3;
    const double det = xx * yy - xy * xy;
    slope_of_[w] << yy / det, -xy / det, -xy / det, xx / det;
  }
  clear();
}

void ChannelPredictor::clear() {
  known_.assign(patches_.wedges.size(), {});
  gradients_.assign(patches_.wedges.size(), Eigen::Vector2d::Zero());
}

void ChannelPredictor::learn(int wedge, WedgeKind kind, double number) {
  known_[wedge][kind] = number;
  if (kind == kAlongX || kind == kAlongY) {
    const Eigen::Matrix2d& i = frames_[vertex_of(wedge)].inverse;
    const double x = known_[wedge][kAlongX], y = known_[wedge][kAlongY];
    gradients_[wedge] = {i(0, 0) * x + i(0, 1) * y, i(1, 0) * x + i(1, 1) * y};
  }
}

Prediction ChannelPredictor::predict(int wedge, WedgeKind kind) const {
  switch (kind) {
    case kValue:
      return predict_value(wedge);
    case kTwist:
      return predict_twist(wedge);
    default:
      return predict_gradient(wedge, kind == kAlongX ? 0 : 1);
  }
}

/// From the mean of the neighbours; terms: parallelograms, the corners across the quads.
Prediction ChannelPredictor::predict_value(int wedge) const {
  double sides = 0, parallelograms = 0, across = 0;
  int side_count = 0, parallelogram_count = 0, across_count = 0;
  for (const int h : corners_[wedge]) {
    const int a = wedge_at(QuadMesh::next(h)), b = wedge_at(QuadMesh::prev(h));
    const int c = wedge_at(QuadMesh::next(QuadMesh::next(h)));
    for (const int side : {a, b}) {
      if (side < wedge) sides += known_[side][kValue], ++side_count;
    }
    if (c < wedge) across += known_[c][kValue], ++across_count;
    if (a < wedge && b < wedge && c < wedge) {
      parallelograms += known_[a][kValue] + known_[b][kValue] - known_[c][kValue];
      ++parallelogram_count;
    }
  }
  Prediction p;
  if (side_count > 0) {
    p.base = sides / side_count;
  } else if (across_count > 0) {
    p.base = across / across_count;
  } else if (wedge > 0) {
    p.base = known_[wedge - 1][kValue];
  }
  if (parallelogram_count > 0) p.terms[0] = parallelograms / parallelogram_count - p.base;
  if (across_count > 0) p.terms[1] = across / across_count - p.base;
  return p;
}

/// Terms: the slope of the plane through the neighbours' values, and the same with the differences
/// that the neighbours' gradients expect, as a cubic spline would have it.
Prediction ChannelPredictor::predict_gradient(int wedge, int axis) const {
  const QuadMesh& mesh = patches_.mesh;
  const int v = vertex_of(wedge);
  Eigen::Vector2d slope(0, 0), expected(0, 0);
  for (const int h : corners_[wedge]) {
    for_each_side(h, [&](int g) {
      const int other = wedge_at(g);
      const Eigen::Vector2d d = mesh.vertices[mesh.origin(g)] - mesh.vertices[v];
      if (d.x() == 0 && d.y() == 0) return;
      const double weight = weight_of(d);
      const double rise = weight * (known_[other][kValue] - known_[wedge][kValue]);
      slope += d * rise;
      if (other < wedge) expected += d * (weight * dot(gradients_[other], d));
    });
  }
  const Eigen::Matrix2d &n = slope_of_[wedge], &r = frames_[v].root;
  const auto in_frame = [&](const Eigen::Vector2d& s) {
    const double x = n(0, 0) * s.x() + n(0, 1) * s.y(), y = n(1, 0) * s.x() + n(1, 1) * s.y();
    return r(axis, 0) * x + r(axis, 1) * y;
  };
  Prediction p;
  p.terms[0] = in_frame(slope);
  p.terms[1] = in_frame(expected);
  return p;
}

/// Terms, means over the corners: how the gradients change along the sides, the mixed difference of
/// the values, and the neighbours' twists.
Prediction ChannelPredictor::predict_twist(int wedge) const {
  const QuadMesh& mesh = patches_.mesh;
  constexpr int kAcrossU[4] = {1, 0, 3, 2}, kAcrossV[4] = {3, 2, 1, 0};
  double change = 0, mixed = 0, neighbours = 0;
  int known = 0;
  for (const int h : corners_[wedge]) {
    const int q = QuadMesh::quad_of(h), k = QuadMesh::corner_of(h);
    const BicubicHermite<Eigen::Vector2d>& geometry = geometry_[q];
    const int sign = twist_sign(mesh, h);
    const auto at = [&](int corner) { return wedge_at(4 * q + corner); };
    const double su = (k == 1 || k == 2) ? -1 : 1, sv = k >= 2 ? -1 : 1;
    const auto along_u = [&](int corner) {
      return dot(gradients_[at(corner)], geometry.du[corner]);
    };
    const auto along_v = [&](int corner) {
      return dot(gradients_[at(corner)], geometry.dv[corner]);
    };
    change +=
        sign * ((along_u(kAcrossV[k]) - along_u(k)) * sv +
                (along_v(kAcrossU[k]) - along_v(k)) * su - dot(gradients_[wedge], geometry.duv[k]));
    mixed += sign * (known_[at(2)][kValue] - known_[at(1)][kValue] - known_[at(3)][kValue] +
                     known_[at(0)][kValue]);
    for (int other = 0; other < 4; ++other) {
      const int w = at(other);
      if (w >= wedge) continue;
      neighbours += sign * twist_sign(mesh, 4 * q + other) * known_[w][kTwist];
      ++known;
    }
  }
  const auto count = static_cast<double>(corners_[wedge].size());
  Prediction p;
  p.terms[0] = change / count;
  p.terms[1] = mixed / count;
  if (known > 0) p.terms[2] = neighbours / known;
  return p;
}

}  // namespace quadrille
