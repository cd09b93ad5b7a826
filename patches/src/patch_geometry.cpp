#include "quadrille/patch_geometry.h"

#include <vector>

#include "edge_ends.h"

namespace quadrille {
namespace {

/// Derivative with respect to arc length, at the middle point, of the parabola through `before`,
/// `middle`, `after` with chord-length parameters.
Eigen::Vector2d parabola_derivative(const Eigen::Vector2d& before, const Eigen::Vector2d& middle,
                                    const Eigen::Vector2d& after) {
  const Eigen::Vector2d in = middle - before, out = after - middle;
  const double a = in.norm(), b = out.norm();
  if (!(a > 0) || !(b > 0)) return Eigen::Vector2d::Zero();
  return (in * (b / a) + out * (a / b)) / (a + b);
}

}  // namespace

void set_bessel_tangents(PatchMesh& patches) {
  const QuadMesh& mesh = patches.mesh;
  const std::vector<int> opposite = opposite_ends(mesh);
  const int end_count = 2 * mesh.edge_count();
  const auto position = [&](int end) { return mesh.vertices[vertex_at(mesh, end)]; };

  // Derivative away from the vertex, per edge end.
  std::vector<Eigen::Vector2d> outward(end_count);
  for (int end = 0; end < end_count; ++end) {
    const Eigen::Vector2d chord = position(end ^ 1) - position(end);
    const int o = opposite[end];
    outward[end] = o < 0 ? chord
                         : parabola_derivative(position(o ^ 1), position(end), position(end ^ 1)) *
                               chord.norm();
  }
  for (int end = 0; end < end_count; ++end) {
    if (opposite[end] >= 0 || opposite[end ^ 1] < 0) continue;
    // The mean of a parabola's end derivatives is its chord.
    outward[end] = 2 * (position(end ^ 1) - position(end)) + outward[end ^ 1];
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    patches.edge_tangents[e] = {outward[2 * e], -outward[2 * e + 1]};
  }
}

}  // namespace quadrille
