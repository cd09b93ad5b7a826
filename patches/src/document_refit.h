#pragma once

#include <vector>

#include "document_metric.h"

namespace quadrille {

/// A picture drawn by patches, sampled where the same patches with vertices moved a little draw
/// it now: 4 x 4 Gauss points per patch.
class MovedPicture {
 public:
  /// `before` and `moved` differ in vertices and tangents only; `metric` is that of `moved`. Both
  /// must outlive this.
  MovedPicture(const PatchMesh& before, const PatchMesh& moved, const PictureMetric& metric);

  /// Colours with which the moved patches draw nearly the same: least squares by conjugate
  /// gradients, from `start` on.
  std::vector<LocalColors> fit(std::vector<LocalColors> start) const;
  /// Mean absolute difference of the picture and the moved patches with `colors`; 1 is white.
  double error(const std::vector<LocalColors>& colors) const;

 private:
  static constexpr int kPoints = 4;
  static constexpr int kSamples = kPoints * kPoints;
  const PatchMesh& moved_;
  const PictureMetric& metric_;
  std::array<std::array<double, 16>, kSamples> basis_;
  std::vector<std::array<Eigen::Array4f, kSamples>> target_;  // channels, per patch

  PatchColors colors_of(int q, const std::vector<LocalColors>& colors) const;
  Eigen::Array4d missing(int q, int sample, const PatchColors& colors) const;
  std::vector<LocalColors> form_times(const std::vector<LocalColors>& colors) const;
  std::vector<LocalColors> residual(const std::vector<LocalColors>& colors) const;
};

}  // namespace quadrille
