#include "edge_polyline.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kFlatness = 1.0 / 128;  // samples
constexpr int kMaxSubdivision = 14;

/// The cubic from p0 to p1 with end derivatives t0, t1, in samples.
struct Curve {
  Vector2d p0, p1, t0, t1;
};

/// Binary logarithm of the number n of pieces of the parameter range for which the chords'
/// deviation |C''| / (8 n^2) meets the flatness; 0 for straight edges.
int subdivision(const Curve& c) {
  const Vector2d chord = c.p1 - c.p0;
  const Vector2d bend0 = 6 * chord - 4 * c.t0 - 2 * c.t1;
  const Vector2d bend1 = -6 * chord + 2 * c.t0 + 4 * c.t1;
  const double length = chord.norm();
  // Handles that only run along the chord change the speed, not the line.
  const auto sideways = [&](const Vector2d& t) {
    return std::abs(chord.x() * t.y() - chord.y() * t.x());
  };
  if (std::max(sideways(c.t0), sideways(c.t1)) <= length * (0.5 / kFixedOne) && length > 0)
    return 0;
  const double deviation = std::max(bend0.norm(), bend1.norm()) / 8;
  int s = 0;
  for (double allowed = kFlatness; s < kMaxSubdivision && deviation > allowed; allowed *= 4) ++s;
  return s;
}

FixedPoint to_fixed(const Vector2d& p) {
  constexpr double kLimit = 0x1p31 - 1;  // whole numbers around stay within int
  if (!p.allFinite()) {
    throw Error(ErrorCode::invalid_argument,
                "a patch has a coordinate that is not a finite number; validate the mesh first");
  }
  if (!(p.cwiseAbs().maxCoeff() < kLimit)) {
    throw Error(ErrorCode::limit_exceeded,
                "a patch reaches to " + std::to_string(p.cwiseAbs().maxCoeff()) +
                    " samples from the origin, beyond 2^31; choose a smaller scale");
  }
  // Adding a number whose last bit counts as 1 rounds to whole numbers, quicker than llround.
  constexpr double kRound = 0x1.8p52;
  return {static_cast<std::int64_t>((p.x() * kFixedOne + kRound) - kRound),
          static_cast<std::int64_t>((p.y() * kFixedOne + kRound) - kRound)};
}

Curve curve_of(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples) {
  const QuadMesh& mesh = patches.mesh;
  const int h = mesh.halfedge(e);
  return {to_samples * mesh.vertices[mesh.origin(h)], to_samples * mesh.vertices[mesh.tip(h)],
          to_samples.linear() * patches.edge_tangents[e][0],
          to_samples.linear() * patches.edge_tangents[e][1]};
}

}  // namespace

int edge_piece_count(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples) {
  return 1 << subdivision(curve_of(patches, e, to_samples));
}

void write_edge_polyline(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples,
                         std::span<FixedPoint> points) {
  const Curve c = curve_of(patches, e, to_samples);
  const std::size_t n = points.size() - 1;
  points[0] = to_fixed(c.p0);
  const double step = 1.0 / static_cast<double>(n);
  for (std::size_t i = 1; i < n; ++i) {
    const auto b = hermite_basis(static_cast<double>(i) * step);
    points[i] = to_fixed(c.p0 * b[0] + c.t0 * b[1] + c.p1 * b[2] + c.t1 * b[3]);
  }
  points[n] = to_fixed(c.p1);
}

}  // namespace quadrille
