#include "fit_smoothness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

// Of the weight of the pixels in a patch, about; the fit is not solved more exactly.
constexpr double kNegligible = 1e-6;
// Edges below it, in pixels, have no direction.
constexpr double kShortest = 1e-6;

/// An edge on one side of which, or on both, the colours of the same two wedges lie.
struct Span {
  int from, to;  // wedges
  Eigen::Vector2d along;
  double area;
};

void add_span(const PatchMesh& patches, const Span& span, double strength, WedgeRows& rows) {
  const double length = span.along.norm();
  if (!(length > kShortest)) return;
  const Eigen::Vector2d across(-span.along.y() / length, span.along.x() / length);
  const auto add = [&](double value, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    std::array<WedgeRows::Entry, 2> entries = {{
        {span.from, Eigen::Vector4d(value, from.x(), from.y(), 0).cast<float>()},
        {span.to, Eigen::Vector4d(-value, to.x(), to.y(), 0).cast<float>()},
    }};
    if (span.from > span.to) std::swap(entries[0], entries[1]);
    rows.add(entries, patches, Eigen::Array4d::Zero());
  };
  // The second derivative of the Hermite cubic along the edge is linear: its mean, and half its
  // change, whose square counts a third. Then the mean mixed derivative, for which the twists stand
  // as much as the edges.
  const double weight = std::sqrt(span.area / 2) * strength;
  const double bend = weight / (length * length), sway = bend / std::numbers::sqrt3;
  const double shear = weight / (length * std::numbers::sqrt2);
  add(0, -bend * span.along, bend * span.along);
  add(6 * sway, 3 * sway * span.along, 3 * sway * span.along);
  add(0, -shear * across, shear * across);
}

}  // namespace

void add_smoothness(const PatchMesh& patches, double length, WedgeRows& rows) {
  const QuadMesh& mesh = patches.mesh;
  const double strength = length * length;
  std::vector<double> area(patches.patch_count(), 0.0), wedge_area(patches.wedges.size(), 0.0);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const double here = std::abs(quad_area(mesh, q));
    if (strength * strength < kNegligible * here * here) continue;
    area[q] = here;
    for (int k = 0; k < 4; ++k) wedge_area[patches.wedge_of_corner[4 * q + k]] += here / 4;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e), twin = mesh.twin(h);
    const auto span_of = [&](int half) {
      return Span{patches.wedge_of_corner[half], patches.wedge_of_corner[QuadMesh::next(half)],
                  mesh.vertices[mesh.tip(half)] - mesh.vertices[mesh.origin(half)],
                  area[QuadMesh::quad_of(half)]};
    };
    Span span = span_of(h);
    if (twin >= 0) {
      const Span other = span_of(twin);
      if (other.from == span.to && other.to == span.from) {
        span.area += other.area;
      } else if (other.area > 0) {
        add_span(patches, other, strength, rows);
      }
    }
    if (span.area > 0) add_span(patches, span, strength, rows);
  }
  for (int w = 0; w < static_cast<int>(wedge_area.size()); ++w) {
    if (!(wedge_area[w] > 0)) continue;
    const double weight = std::sqrt(wedge_area[w]) * strength;
    const WedgeRows::Entry twist = {w, Eigen::Vector4d(0, 0, 0, weight).cast<float>()};
    rows.add({&twist, 1}, patches, Eigen::Array4d::Zero());
  }
}

}  // namespace quadrille
