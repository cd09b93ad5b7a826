#pragma once

#include <Eigen/Core>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Sum over the corners of quad q of (|a|^2 + |b|^2) / (2 det(a, b)) with the sides a, b that meet
/// there: 4 for a square, infinite when a corner is not strictly convex (Hormann, Greiner, MIPS,
/// 2000, applied corner by corner).
double shape_energy(const QuadMesh& mesh, int q);
/// Their sum over all quads; the same bits for any thread count.
double shape_energy(const QuadMesh& mesh);

/// Its derivatives by the corners' positions, numbered 2 corner + axis. The matrix is that of
/// Gauss and Newton for the energy as a sum of squares, which is never negative. All corners
/// strictly convex.
struct ShapeDerivatives {
  Eigen::Matrix<double, 8, 1> gradient;
  Eigen::Matrix<double, 8, 8> matrix;
};
ShapeDerivatives shape_derivatives(const QuadMesh& mesh, int q);

}  // namespace quadrille
