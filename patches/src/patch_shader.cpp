#include "patch_shader.h"

#include <algorithm>
#include <cmath>

namespace quadrille {

GeometryCoefficients geometry_coefficients(const NormalizedPatch& normalized,
                                           const Eigen::Affine2d& map) {
  GeometryCoefficients c;
  for (int d = 0; d < 2; ++d) {
    for (int k = 0; k < 3; ++k) c.map[d][k] = static_cast<float>(map(d, k));
    for (int k = 0; k < 6; ++k) c.start[d][k] = static_cast<float>(normalized.start[k][d]);
    for (int k = 0; k < 16; ++k) {
      c.position[d][k] = static_cast<float>(normalized.position[k / 4][k % 4][d]);
    }
  }
  return c;
}

PatchShader::PatchShader(const PatchMesh& patches, int patch, const Eigen::Affine2d& to_samples,
                         const Eigen::Affine2d& from_samples)
    : opaque_(patches.opaque) {
  const FergusonPatch ferguson = ferguson_patch(patches, patch);
  geometry_ = ferguson.position;
  const NormalizedPatch normalized(geometry_);
  const Eigen::Vector2d center = to_samples * normalized.center.matrix();
  origin_ = {static_cast<int>(std::floor(center.x())), static_cast<int>(std::floor(center.y()))};
  to_mesh_ = from_samples * Eigen::Translation2d(origin_[0], origin_[1]);
  const Eigen::Affine2d map = Eigen::Scaling(1 / normalized.size) *
                              Eigen::Translation2d(-normalized.center.matrix()) * to_mesh_;
  const PowerBasis<Color> color = power_basis(ferguson.color);
  PatchCoefficients& c = coefficients_;
  c.geometry = geometry_coefficients(normalized, map);
  for (int d = 0; d < 4; ++d) {
    for (int k = 0; k < 16; ++k) c.color[d][k] = color[k / 4][k % 4][d];
  }
}

void PatchShader::shade(Batch& batch) {
  if (batch.count == 0) return;
  const int padded = padded_count(batch.count);
  std::fill(batch.x + batch.count, batch.x + padded, batch.x[batch.count - 1]);
  std::fill(batch.y + batch.count, batch.y + padded, batch.y[batch.count - 1]);
  alignas(64) int found[kBatch];
  shade_lanes(coefficients_, opaque_,
              {padded,
               batch.x,
               batch.y,
               {batch.color[0], batch.color[1], batch.color[2], batch.color[3]},
               found});
  for (int i = 0; i < batch.count; ++i) {
    if (!found[i]) shade_hard_point(batch, i);
  }
}

void PatchShader::shade_hard_point(Batch& batch, int i) {
  if (!inverse_) inverse_.emplace(geometry_);
  const Eigen::Vector2d at = (*inverse_)(to_mesh_ * Eigen::Vector2d(batch.x[i], batch.y[i]));
  float color[4];
  shade_at(coefficients_, opaque_, static_cast<float>(at.x()), static_cast<float>(at.y()), color);
  for (int k = 0; k < 4; ++k) batch.color[k][i] = color[k];
}

}  // namespace quadrille
