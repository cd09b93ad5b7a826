#include "fit_element.h"

namespace quadrille {
namespace {

constexpr std::array<double, 7> kChoose6 = {1, 6, 15, 20, 15, 6, 1};

}  // namespace

std::array<CornerMap, 4> corner_maps(const PatchMesh& patches, int q) {
  const BicubicHermite<Eigen::Vector2d> p = patch_geometry(patches, q);
  std::array<CornerMap, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const double twist = twist_sign(patches.mesh, 4 * q + k) * p.du[k].norm() * p.dv[k].norm();
    corners[k] = {p.du[k].cast<float>(), p.dv[k].cast<float>(), p.duv[k].cast<float>(),
                  static_cast<float>(twist)};
  }
  return corners;
}

BicubicBezier<Color> colors_of(const std::array<CornerMap, 4>& corners, const CornerUnknowns& x) {
  BicubicHermite<Color> color;
  for (int k = 0; k < 4; ++k) {
    const CornerMap& c = corners[k];
    const Color dx = x[k].col(1).array(), dy = x[k].col(2).array();
    color.value[k] = x[k].col(0).array();
    color.du[k] = dx * c.du.x() + dy * c.du.y();
    color.dv[k] = dx * c.dv.x() + dy * c.dv.y();
    color.duv[k] = dx * c.duv.x() + dy * c.duv.y() + x[k].col(3).array() * c.twist;
  }
  return to_bezier(color);
}

CornerUnknowns transpose_of(const std::array<CornerMap, 4>& corners,
                            const BicubicBezier<Color>& gradient) {
  constexpr int kColumn[4] = {0, 3, 3, 0}, kRow[4] = {0, 0, 3, 3};
  CornerUnknowns y;
  for (int k = 0; k < 4; ++k) {
    const int i = kColumn[k], j = kRow[k];
    const int di = i == 0 ? 1 : -1, dj = j == 0 ? 1 : -1;
    const float su = static_cast<float>(di) / 3, sv = static_cast<float>(dj) / 3;
    const Color& along_u = gradient.control[j][i + di];
    const Color& along_v = gradient.control[j + dj][i];
    const Color& inner = gradient.control[j + dj][i + di];
    const Color value = gradient.control[j][i] + along_u + along_v + inner;
    const Color du = (along_u + inner) * su, dv = (along_v + inner) * sv;
    const Color duv = inner * (su * sv);
    const CornerMap& c = corners[k];
    y[k].col(0) = value;
    y[k].col(1) = du * c.du.x() + dv * c.dv.x() + duv * c.duv.x();
    y[k].col(2) = du * c.du.y() + dv * c.dv.y() + duv * c.duv.y();
    y[k].col(3) = duv * c.twist;
  }
  return y;
}

std::array<Eigen::Vector4f, 4> corner_factors(const std::array<CornerMap, 4>& corners,
                                              const Eigen::Vector2d& uv) {
  const auto bernstein = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto u = bernstein(uv.x()), v = bernstein(uv.y());
  BicubicBezier<Color> weights;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      weights.control[j][i] = Color::Constant(static_cast<float>(u[i] * v[j]));
    }
  }
  const CornerUnknowns all = transpose_of(corners, weights);
  std::array<Eigen::Vector4f, 4> factors;
  for (int k = 0; k < 4; ++k) factors[k] = all[k].row(0).transpose();
  return factors;
}

std::array<double, 49> uniform_moments(double weight) {
  std::array<double, 49> moments;
  for (int q = 0; q < 7; ++q) {
    for (int p = 0; p < 7; ++p) moments[7 * q + p] = weight / (49 * kChoose6[q] * kChoose6[p]);
  }
  return moments;
}

}  // namespace quadrille
