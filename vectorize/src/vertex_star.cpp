#include "vertex_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kParallel = 1e-9;  // sine below which directions count as the same
constexpr int kNewtonSteps = 3;
constexpr int kHalvings = 7;
constexpr double kBoldest = 2;  // first try, in Newton steps: those are short near the barrier
// In units of the mean edge at the vertex:
constexpr double kUntangling = 0.05;     // d^2 of the replaced determinant
constexpr double kConverged = 1e-3;      // length of a step
constexpr double kLargestStep = 0.5;     // likewise
constexpr double kLeastCurvature = 1.0;  // added to the Newton matrix

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double corner_sine(const Vector2d& a, const Vector2d& b) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? cross(a, b) / lengths : 0;
}

/// Gradient and an approximate Hessian in the position of the vertex.
struct Slope {
  Vector2d gradient = Vector2d::Zero();
  double xx = 0, xy = 0, yy = 0;
};

/// Calls visit(a, b, da, db) for the three corners of a wedge: the sides a (to the next corner) and
/// b (to the one before) and their derivatives in p, which are multiples of the identity.
template <class Visit>
void for_corners(const StarWedge& w, const Vector2d& p, const Visit& visit) {
  visit(Vector2d(w.after - p), Vector2d(w.before - p), -1.0, -1.0);
  visit(Vector2d(w.after2 - w.after), Vector2d(p - w.after), 0.0, 1.0);
  visit(Vector2d(p - w.before), Vector2d(w.before2 - w.before), 1.0, 0.0);
}

class ShapeEnergy {
 public:
  ShapeEnergy(std::span<const StarWedge> wedges, const Vector2d& start, const Vector2d& anchor,
              double hold)
      : wedges_(wedges), anchor_(anchor) {
    double smallest = std::numeric_limits<double>::max();
    for (const StarWedge& w : wedges) {
      edge2_ += 0.5 * ((w.before - start).squaredNorm() + (w.after - start).squaredNorm());
      for_corners(w, start, [&](const Vector2d& a, const Vector2d& b, double, double) {
        smallest = std::min(smallest, cross(a, b));
      });
    }
    edge2_ /= static_cast<double>(wedges.size());
    spring_ = hold / edge2_;
    if (smallest <= 0) untangling_ = kUntangling * edge2_ - smallest;
  }

  double edge2() const { return edge2_; }

  double value(const Vector2d& p) const {
    double sum = spring_ * (p - anchor_).squaredNorm();
    bool is_finite = true;
    for (const StarWedge& w : wedges_) {
      for_corners(w, p, [&](const Vector2d& a, const Vector2d& b, double, double) {
        const double d = determinant(cross(a, b));
        is_finite = is_finite && d > 0;
        sum += a.squaredNorm() * b.squaredNorm() / (d * d);
      });
    }
    return is_finite ? sum : std::numeric_limits<double>::infinity();
  }

  Slope slope(const Vector2d& p) const {
    Slope s;
    s.gradient = 2 * spring_ * (p - anchor_);
    s.xx = s.yy = 2 * spring_;
    for (const StarWedge& w : wedges_) {
      for_corners(w, p, [&](const Vector2d& a, const Vector2d& b, double da, double db) {
        add_corner(a, b, da, db, s);
      });
    }
    return s;
  }

 private:
  std::span<const StarWedge> wedges_;
  Vector2d anchor_;
  double edge2_ = 0, spring_ = 0, untangling_ = 0;

  double determinant(double d) const {
    return untangling_ > 0 ? 0.5 * (d + std::sqrt(d * d + untangling_ * untangling_)) : d;
  }
  double determinant_slope(double d) const {
    return untangling_ > 0 ? 0.5 * (1 + d / std::sqrt(d * d + untangling_ * untangling_)) : 1;
  }

  /// f = |a|^2 |b|^2 / h^2 has the gradient f g with g = grad log f, and the Hessian
  /// f (g g^T + 2 gh gh^T + ...) with gh = grad log h. What is left out, the second derivatives of
  /// log |a|^2 and log |b|^2, has no trace, and keeping it could make the sum indefinite.
  void add_corner(const Vector2d& a, const Vector2d& b, double da, double db, Slope& s) const {
    const double d = cross(a, b), h = determinant(d), aa = a.squaredNorm(), bb = b.squaredNorm();
    const double f = aa * bb / (h * h);
    const Vector2d d_slope(da * b.y() - db * a.y(), db * a.x() - da * b.x());
    const Vector2d gh = determinant_slope(d) / h * d_slope;
    const Vector2d g = 2 * da / aa * a + 2 * db / bb * b - 2 * gh;
    s.gradient += f * g;
    s.xx += f * (g.x() * g.x() + 2 * gh.x() * gh.x());
    s.xy += f * (g.x() * g.y() + 2 * gh.x() * gh.y());
    s.yy += f * (g.y() * g.y() + 2 * gh.y() * gh.y());
  }
};

Vector2d newton_step(const Slope& s, const VertexGuide& guide, double least_curvature) {
  const double xx = s.xx + least_curvature, yy = s.yy + least_curvature;
  const Vector2d& u = guide.direction;
  if (guide.kind == VertexGuide::Kind::line) {
    const double curvature = u.x() * u.x() * xx + 2 * u.x() * u.y() * s.xy + u.y() * u.y() * yy;
    return -s.gradient.dot(u) / curvature * u;
  }
  return Vector2d(s.xy * s.gradient.y() - yy * s.gradient.x(),
                  s.xy * s.gradient.x() - xx * s.gradient.y()) /
         (xx * yy - s.xy * s.xy);
}

/// The point of the guide nearest to p.
Vector2d on_guide(const Vector2d& p, const VertexGuide& guide) {
  if (guide.kind != VertexGuide::Kind::line) return p;
  return guide.point + guide.direction.dot(p - guide.point) * guide.direction;
}

}  // namespace

bool VertexGuide::is_same_line(const VertexGuide& other) const {
  if (kind != Kind::line || other.kind != Kind::line) return false;
  const Vector2d between = other.point - point;
  return std::abs(cross(direction, other.direction)) <= kParallel &&
         std::abs(cross(direction, between)) <= kParallel * between.norm();
}

double VertexStar::smallest_sine(const Vector2d& p) const {
  double smallest = 1;
  for (const StarWedge& w : wedges_) {
    for_corners(w, p, [&](const Vector2d& a, const Vector2d& b, double, double) {
      smallest = std::min(smallest, corner_sine(a, b));
    });
  }
  return smallest;
}

Vector2d VertexStar::improved(const Vector2d& start, const VertexGuide& guide,
                              const Vector2d& anchor, double hold) const {
  if (guide.kind == VertexGuide::Kind::fixed) return start;
  const ShapeEnergy energy(wedges_, start, anchor, hold);
  const double edge = std::sqrt(energy.edge2());
  if (!(edge > 0)) return start;
  Vector2d p = start;
  double value = energy.value(p);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vector2d step = newton_step(energy.slope(p), guide, kLeastCurvature / energy.edge2());
    const double length = step.norm();
    if (!(length > kConverged * edge)) return p;
    double share = std::min(kBoldest, kLargestStep * edge / length);
    bool is_lower = false;
    for (int k = 0; k < kHalvings && !is_lower; ++k, share /= 2) {
      const Vector2d q = on_guide(p + share * step, guide);
      const double at_q = energy.value(q);
      if (!(at_q < value)) continue;
      p = q;
      value = at_q;
      is_lower = true;
    }
    if (!is_lower) return p;
  }
  return p;
}

}  // namespace quadrille
