#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "patch_inverse.h"
#include "patch_lanes.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// The normalized patch as floats; `map` takes given points to normalized ones.
GeometryCoefficients geometry_coefficients(const NormalizedPatch& normalized,
                                           const Eigen::Affine2d& map);

/// Colours of one patch at points of a sample grid, many at a time, in float. The error against
/// exact evaluation stays below 1/50 of an 8-bit step. What a point gets depends on the patch and
/// the point only, not on the points that are shaded along with it.
class PatchShader {
 public:
  static constexpr int kBatch = 64;
  static_assert(kBatch % kLaneCount == 0);

  /// Points in samples relative to origin(), and their colours; only the first `count` count.
  struct Batch {
    int count = 0;
    alignas(64) float x[kBatch], y[kBatch];
    alignas(64) float color[4][kBatch];  ///< premultiplied, 0 <= r, g, b <= alpha <= 1
  };

  /// `from_samples` takes samples to the mesh's coordinates, `to_samples` back.
  PatchShader(const PatchMesh& patches, int patch, const Eigen::Affine2d& to_samples,
              const Eigen::Affine2d& from_samples);

  /// A whole sample position near the patch, so that relative positions are small.
  std::array<int, 2> origin() const { return origin_; }

  void shade(Batch& batch);

 private:
  BicubicHermite<Eigen::Vector2d> geometry_;
  Eigen::Affine2d to_mesh_;  // from samples relative to the origin
  std::array<int, 2> origin_;
  bool opaque_;
  PatchCoefficients coefficients_;
  std::optional<PatchInverse> inverse_;  // made when first needed

  void shade_hard_point(Batch& batch, int i);
};

}  // namespace quadrille
