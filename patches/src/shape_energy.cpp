#include "shape_energy.h"

#include <array>
#include <limits>

#include "parallel_ranges.h"

namespace quadrille {
namespace {

/// The sides at corner k: to the next corner, and to the one before.
struct Corner {
  int at, next, before;
  Eigen::Vector4d sides;  ///< a.x, a.y, b.x, b.y
  double determinant;
};

Corner corner(const QuadMesh& mesh, int q, int k) {
  Corner c{k, (k + 1) & 3, (k + 3) & 3, {}, 0};
  const auto& quad = mesh.quads()[q];
  const Eigen::Vector2d p = mesh.vertices[quad[k]];
  c.sides << mesh.vertices[quad[c.next]] - p, mesh.vertices[quad[c.before]] - p;
  c.determinant = c.sides[0] * c.sides[3] - c.sides[1] * c.sides[2];
  return c;
}

}  // namespace

double shape_energy(const QuadMesh& mesh, int q) {
  double energy = 0;
  for (int k = 0; k < 4; ++k) {
    const Corner c = corner(mesh, q, k);
    if (!(c.determinant > 0)) return std::numeric_limits<double>::infinity();
    energy += c.sides.squaredNorm() / (2 * c.determinant);
  }
  return energy;
}

double shape_energy(const QuadMesh& mesh) {
  return sum_over_ranges(mesh.quad_count(), 0.0, [&](int begin, int end) {
    double sum = 0;
    for (int q = begin; q < end; ++q) sum += shape_energy(mesh, q);
    return sum;
  });
}

ShapeDerivatives shape_derivatives(const QuadMesh& mesh, int q) {
  ShapeDerivatives result;
  result.gradient.setZero();
  result.matrix.setZero();
  for (int k = 0; k < 4; ++k) {
    // The corner's energy is |w|^2 with w = sides / sqrt(2 det).
    const Corner c = corner(mesh, q, k);
    const Eigen::Vector4d& s = c.sides;
    const Eigen::Vector4d by_sides(s[3], -s[2], -s[1], s[0]);  // of the determinant
    const double n = s.squaredNorm(), d = c.determinant;
    const Eigen::Vector4d gradient = s / d - by_sides * (n / (2 * d * d));
    const Eigen::Matrix4d cross = s * by_sides.transpose();
    const Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity() / d -
                                   (cross + cross.transpose()) / (2 * d * d) +
                                   by_sides * by_sides.transpose() * (n / (4 * d * d * d));
    const std::array<int, 2> ends = {c.next, c.before};
    for (int i = 0; i < 2; ++i) {
      const auto part = gradient.segment<2>(2 * i);
      result.gradient.segment<2>(2 * ends[i]) += part;
      result.gradient.segment<2>(2 * c.at) -= part;
      for (int j = 0; j < 2; ++j) {
        const auto block = matrix.block<2, 2>(2 * i, 2 * j);
        result.matrix.block<2, 2>(2 * ends[i], 2 * ends[j]) += block;
        result.matrix.block<2, 2>(2 * ends[i], 2 * c.at) -= block;
        result.matrix.block<2, 2>(2 * c.at, 2 * ends[j]) -= block;
        result.matrix.block<2, 2>(2 * c.at, 2 * c.at) += block;
      }
    }
  }
  return result;
}

}  // namespace quadrille
