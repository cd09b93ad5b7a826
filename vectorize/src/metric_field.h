#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "quadrille/cross_field.h"

namespace quadrille {

/// A value for each of a cross's two axes, such as the logarithm of the edge length along it.
struct AxisPair {
  float x = 0, y = 0;
};

/// The same as a symmetric tensor, which does not depend on how the axes are named: crosses a
/// quarter turn apart, whose axes are swapped, describe it alike (where p of Eq. 2 is odd, alpha
/// and beta change places). So tensors may be averaged and interpolated where lengths may not.
struct MetricTensor {
  float mean = 0;                    ///< of both values
  std::complex<float> deviator = 0;  ///< half their difference times e^{2 i theta}

  MetricTensor() = default;
  /// `axis` is e^{i theta}.
  MetricTensor(const AxisPair& pair, std::complex<float> axis)
      : mean(0.5f * (pair.x + pair.y)), deviator(axis * axis * (0.5f * (pair.x - pair.y))) {}

  AxisPair along(std::complex<float> axis) const {
    const std::complex<float> twice = axis * axis;
    const float half = deviator.real() * twice.real() + deviator.imag() * twice.imag();
    return {mean + half, mean - half};
  }
  MetricTensor& add(float share, const MetricTensor& other) {
    mean += share * other.mean;
    deviator += share * other.deviator;
    return *this;
  }
};

/// The turn from one cross to another and whether their axes are swapped.
struct CrossMatching {
  float turn;    ///< radians, in [-pi/4, pi/4]
  bool swapped;  ///< the x-axis of one is the y-axis of the other

  /// From and to the angles of any of the crosses' axes, radians.
  CrossMatching(float from, float to) {
    constexpr float kQuarter = 1.57079632679f;
    const long quarters = std::lround((to - from) / kQuarter);
    turn = to - from - kQuarter * static_cast<float>(quarters);
    swapped = quarters % 2 != 0;
  }
};

/// Cross field and metric averaged over squares of `factor` working pixels.
struct CoarseMetric {
  int factor = 1;
  FieldGrid<std::complex<float>> z;
  FieldGrid<float> angle;
  FieldGrid<AxisPair> lengths;

  CoarseMetric(const CrossField& field, const FieldGrid<AxisPair>& fine, int factor);
  FieldGrid<MetricTensor> tensors() const;
};

/// The tensors of a grid of squares of `factor` working pixels, between their centres by bilinear
/// interpolation, at working pixel (x, y).
MetricTensor interpolated(const FieldGrid<MetricTensor>& tensors, int factor, int x, int y);

}  // namespace quadrille
