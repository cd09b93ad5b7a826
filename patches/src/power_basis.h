#pragma once

#include <array>

#include "quadrille/bicubic.h"

namespace quadrille {

/// Coefficients of a bicubic polynomial: coefficient[j][i] weighs u^i v^j.
template <class T>
using PowerBasis = std::array<std::array<T, 4>, 4>;

/// The cubic with values v0, v1 and derivatives d0, d1 at 0 and 1. Equal values and zero
/// derivatives give exact zeros above the constant.
template <class T>
std::array<T, 4> cubic_coefficients(const T& v0, const T& d0, const T& v1, const T& d1) {
  using S = typename T::Scalar;
  const T rise = v1 - v0;
  return {v0, d0, rise * S(3) - d0 * S(2) - d1, d0 + d1 - rise * S(2)};
}

template <class T>
PowerBasis<T> power_basis(const BicubicHermite<T>& h) {
  // Rows: value and v derivative on the side v = 0, then on the side v = 1.
  const PowerBasis<T> rows = {
      cubic_coefficients<T>(h.value[0], h.du[0], h.value[1], h.du[1]),
      cubic_coefficients<T>(h.dv[0], h.duv[0], h.dv[1], h.duv[1]),
      cubic_coefficients<T>(h.value[3], h.du[3], h.value[2], h.du[2]),
      cubic_coefficients<T>(h.dv[3], h.duv[3], h.dv[2], h.duv[2]),
  };
  PowerBasis<T> c;
  for (int i = 0; i < 4; ++i) {
    const auto column = cubic_coefficients<T>(rows[0][i], rows[1][i], rows[2][i], rows[3][i]);
    for (int j = 0; j < 4; ++j) c[j][i] = column[j];
  }
  return c;
}

}  // namespace quadrille
