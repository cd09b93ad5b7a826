#pragma once

#include <Eigen/Core>
#include <array>

namespace quadrille {

/// The four cubic Hermite basis functions at t in the order value at 0, derivative at 0, value at
/// 1, derivative at 1.
std::array<double, 4> hermite_basis(double t);
/// Their first derivatives.
std::array<double, 4> hermite_basis_derivative(double t);

/// A bicubic Hermite (Ferguson) patch of one quantity T over (u, v) in [0, 1]^2. Arrays are indexed
/// by corner: 0, 1, 2, 3 at (u, v) = (0,0), (1,0), (1,1), (0,1).
template <class T>
struct BicubicHermite {
  std::array<T, 4> value, du, dv, duv;

  T at(double u, double v) const { return combine(hermite_basis(u), hermite_basis(v)); }
  T derivative_u(double u, double v) const {
    return combine(hermite_basis_derivative(u), hermite_basis(v));
  }
  T derivative_v(double u, double v) const {
    return combine(hermite_basis(u), hermite_basis_derivative(v));
  }

 private:
  T combine(const std::array<double, 4>& bu, const std::array<double, 4>& bv) const {
    using S = typename T::Scalar;
    const auto corner = [&](int k, int iu, int iv) -> T {
      return value[k] * S(bu[iu] * bv[iv]) + du[k] * S(bu[iu + 1] * bv[iv]) +
             dv[k] * S(bu[iu] * bv[iv + 1]) + duv[k] * S(bu[iu + 1] * bv[iv + 1]);
    };
    return corner(0, 0, 0) + corner(1, 2, 0) + corner(2, 2, 2) + corner(3, 0, 2);
  }
};

/// A bicubic Bezier patch of one quantity T: control[j][i] weighs B_i(u) B_j(v).
template <class T>
struct BicubicBezier {
  std::array<std::array<T, 4>, 4> control;

  T at(double u, double v) const {
    std::array<T, 4> column;
    for (int j = 0; j < 4; ++j) column[j] = casteljau(control[j], u);
    return casteljau(column, v);
  }

  /// The two halves at u = 1/2 (de Casteljau); exact up to rounding.
  std::array<BicubicBezier, 2> split_u() const {
    std::array<BicubicBezier, 2> half;
    for (int j = 0; j < 4; ++j) split(control[j], half[0].control[j], half[1].control[j]);
    return half;
  }
  /// The two halves at v = 1/2.
  std::array<BicubicBezier, 2> split_v() const {
    std::array<BicubicBezier, 2> half;
    for (int i = 0; i < 4; ++i) {
      std::array<T, 4> column, low, high;
      for (int j = 0; j < 4; ++j) column[j] = control[j][i];
      split(column, low, high);
      for (int j = 0; j < 4; ++j) half[0].control[j][i] = low[j], half[1].control[j][i] = high[j];
    }
    return half;
  }

 private:
  using S = typename T::Scalar;
  static T casteljau(const std::array<T, 4>& p, double t) {
    const S s = S(1 - t), r = S(t);
    return p[0] * (s * s * s) + p[1] * (S(3) * s * s * r) + p[2] * (S(3) * s * r * r) +
           p[3] * (r * r * r);
  }
  static void split(const std::array<T, 4>& p, std::array<T, 4>& low, std::array<T, 4>& high) {
    const S half = S(0.5);
    const T a = (p[0] + p[1]) * half, b = (p[1] + p[2]) * half, c = (p[2] + p[3]) * half;
    const T ab = (a + b) * half, bc = (b + c) * half, middle = (ab + bc) * half;
    low = {p[0], a, ab, middle};
    high = {middle, bc, c, p[3]};
  }
};

/// The same polynomial in Bezier form, for example b_11 = P + P_u/3 + P_v/3 + P_uv/9 at corner 0.
template <class T>
BicubicBezier<T> to_bezier(const BicubicHermite<T>& h) {
  using S = typename T::Scalar;
  constexpr int kColumn[4] = {0, 3, 3, 0}, kRow[4] = {0, 0, 3, 3};
  const S third = S(1) / S(3);
  BicubicBezier<T> b;
  for (int k = 0; k < 4; ++k) {
    const int i = kColumn[k], j = kRow[k];
    const int di = i == 0 ? 1 : -1, dj = j == 0 ? 1 : -1;
    const S su = S(di) * third, sv = S(dj) * third;
    b.control[j][i] = h.value[k];
    b.control[j][i + di] = h.value[k] + h.du[k] * su;
    b.control[j + dj][i] = h.value[k] + h.dv[k] * sv;
    b.control[j + dj][i + di] = h.value[k] + h.du[k] * su + h.dv[k] * sv + h.duv[k] * (su * sv);
  }
  return b;
}

}  // namespace quadrille
