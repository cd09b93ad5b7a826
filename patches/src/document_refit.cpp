#include "document_refit.h"

#include <cmath>

namespace quadrille {
namespace {

using Eigen::Array4d;
constexpr int kIterations = 8;

/// Gauss-Legendre points and weights on [0, 1]: exact up to degree 7.
constexpr double kAt[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                           0.93056815579702629};
constexpr double kWeight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                               0.17392742256872693};

/// The Hermite basis of a patch at (u, v), in the order of PatchColors.
std::array<double, 16> basis_at(double u, double v) {
  constexpr int kAtU[4] = {0, 2, 2, 0}, kAtV[4] = {0, 0, 2, 2};
  const auto bu = hermite_basis(u), bv = hermite_basis(v);
  std::array<double, 16> basis;
  for (int n = 0; n < 16; ++n) {
    basis[n] = bu[kAtU[n / 4] + (n & 1)] * bv[kAtV[n / 4] + (n >> 1 & 1)];
  }
  return basis;
}

/// Where the patch `geometry` has the point near (u, v): one step of Newton's method, as points
/// move by a small part of a patch.
Eigen::Vector2d parameters_of(const BicubicHermite<Eigen::Vector2d>& geometry, double u, double v,
                              const Eigen::Vector2d& point) {
  constexpr double kFarthest = 0.25;
  const Eigen::Vector2d d = point - geometry.at(u, v);
  if (d.x() == 0 && d.y() == 0) return {u, v};
  const Eigen::Vector2d pu = geometry.derivative_u(u, v), pv = geometry.derivative_v(u, v);
  const double det = pu.x() * pv.y() - pu.y() * pv.x();
  const double du = (d.x() * pv.y() - d.y() * pv.x()) / det;
  const double dv = (pu.x() * d.y() - pu.y() * d.x()) / det;
  if (!(std::abs(du) < kFarthest && std::abs(dv) < kFarthest)) return {u, v};
  return {u + du, v + dv};
}

double weight_of(int sample) { return kWeight[sample % 4] * kWeight[sample / 4]; }

Array4d ratio(const Array4d& a, const Array4d& b) { return (b > 0).select(a / b, 0); }

/// a + factor * b.
LocalColors plus(const LocalColors& a, const Array4d& factor, const LocalColors& b) {
  LocalColors sum;
  for (int k = 0; k < 4; ++k) sum[k] = a[k] + factor * b[k];
  return sum;
}

Array4d dot(const LocalColors& a, const LocalColors& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

std::vector<LocalColors> zeros(int count) {
  LocalColors zero;
  zero.fill(Array4d::Zero());
  return std::vector<LocalColors>(count, zero);
}

}  // namespace

MovedPicture::MovedPicture(const PatchMesh& before, const PatchMesh& moved,
                           const PictureMetric& metric)
    : moved_(moved), metric_(metric), target_(moved.patch_count()) {
  for (int i = 0; i < kSamples; ++i) basis_[i] = basis_at(kAt[i % kPoints], kAt[i / kPoints]);
  for (int q = 0; q < moved.patch_count(); ++q) {
    const FergusonPatch was = ferguson_patch(before, q);
    const BicubicHermite<Eigen::Vector2d> is = patch_geometry(moved, q);
    for (int i = 0; i < kSamples; ++i) {
      const double u = kAt[i % kPoints], v = kAt[i / kPoints];
      const Eigen::Vector2d at = parameters_of(was.position, u, v, is.at(u, v));
      target_[q][i] = channels_of(was.color.at(at.x(), at.y())).cast<float>();
      if (moved.opaque) target_[q][i][kAlpha] = 0;
    }
  }
}

/// Preconditioned by the blocks of the wedges; every channel is a system of its own.
std::vector<LocalColors> MovedPicture::fit(std::vector<LocalColors> x) const {
  const auto count = static_cast<int>(x.size());
  std::vector<LocalColors> left = residual(x), direction = zeros(count);
  Array4d last = Array4d::Zero();
  for (int i = 0; i < kIterations; ++i) {
    Array4d now = Array4d::Zero();
    for (int w = 0; w < count; ++w) now += dot(metric_.solve_block(w, left[w]), left[w]);
    const Array4d beta = ratio(now, last);
    for (int w = 0; w < count; ++w) {
      direction[w] = plus(metric_.solve_block(w, left[w]), beta, direction[w]);
    }
    const std::vector<LocalColors> product = form_times(direction);
    Array4d curvature = Array4d::Zero();
    for (int w = 0; w < count; ++w) curvature += dot(direction[w], product[w]);
    const Array4d alpha = ratio(now, curvature);
    for (int w = 0; w < count; ++w) {
      x[w] = plus(x[w], alpha, direction[w]);
      left[w] = plus(left[w], -alpha, product[w]);
    }
    last = now;
  }
  return x;
}

double MovedPicture::error(const std::vector<LocalColors>& colors) const {
  double sum = 0, area = 0;
  for (int q = 0; q < metric_.patch_count(); ++q) {
    const PatchColors patch = colors_of(q, colors);
    double of_patch = 0;
    for (int i = 0; i < kSamples; ++i) {
      of_patch += weight_of(i) * color_of(missing(q, i, patch)).abs().sum();
    }
    sum += metric_.area(q) * of_patch;
    area += metric_.area(q);
  }
  return area > 0 ? sum / (area * (moved_.opaque ? 3 : 4)) : 0;
}

PatchColors MovedPicture::colors_of(int q, const std::vector<LocalColors>& colors) const {
  PatchColors patch;
  for (int h = 4 * q; h < 4 * q + 4; ++h) metric_.put(h, colors[moved_.wedge_of_corner[h]], patch);
  return patch;
}

Array4d MovedPicture::missing(int q, int sample, const PatchColors& colors) const {
  Array4d missing = target_[q][sample].cast<double>();
  for (int n = 0; n < 16; ++n) missing -= basis_[sample][n] * colors[n];
  return missing;
}

std::vector<LocalColors> MovedPicture::form_times(const std::vector<LocalColors>& colors) const {
  std::vector<LocalColors> result = zeros(metric_.wedge_count());
  for (int q = 0; q < metric_.patch_count(); ++q) {
    const PatchColors products = PictureMetric::products(colors_of(q, colors));
    for (int h = 4 * q; h < 4 * q + 4; ++h) {
      metric_.add_integrals(h, products, result[moved_.wedge_of_corner[h]]);
    }
  }
  return result;
}

/// Integrals of what is missing times the functions of the wedges.
std::vector<LocalColors> MovedPicture::residual(const std::vector<LocalColors>& colors) const {
  std::vector<LocalColors> result = zeros(metric_.wedge_count());
  for (int q = 0; q < metric_.patch_count(); ++q) {
    const PatchColors patch = colors_of(q, colors);
    PatchColors integrals;
    integrals.fill(Array4d::Zero());
    for (int i = 0; i < kSamples; ++i) {
      const Array4d weighted = weight_of(i) * missing(q, i, patch);
      for (int n = 0; n < 16; ++n) integrals[n] += basis_[i][n] * weighted;
    }
    for (int h = 4 * q; h < 4 * q + 4; ++h) {
      metric_.add_integrals(h, integrals, result[moved_.wedge_of_corner[h]]);
    }
  }
  return result;
}

}  // namespace quadrille
