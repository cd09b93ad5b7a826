#include "quadrille/bicubic.h"

namespace quadrille {

std::array<double, 4> hermite_basis(double t) {
  const double s = 1 - t;
  return {s * s * (1 + 2 * t), s * s * t, t * t * (3 - 2 * t), -t * t * s};
}

std::array<double, 4> hermite_basis_derivative(double t) {
  return {6 * t * (t - 1), (1 - t) * (1 - 3 * t), 6 * t * (1 - t), t * (3 * t - 2)};
}

}  // namespace quadrille
