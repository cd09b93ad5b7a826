#pragma once

#include <vector>

#include "element_lanes.h"
#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "wedge_corners.h"

namespace quadrille {

/// The normal equations of fitting a correction to the colours that a PatchMesh has: unknowns per
/// wedge, one equation per pixel centre, element by element. It runs in the caller's tbb arena.
class ColorSystem {
 public:
  using Vector = std::vector<WedgeUnknowns>;

  /// Scans the picture. The correction is damped as if every square pixel had another equation of
  /// weight `regularization` that asks for no correction.
  ColorSystem(const PatchMesh& patches, const Raster& picture, double regularization,
              const RunContext& context);

  int wedge_count() const { return static_cast<int>(right_hand_side.size()); }

  /// product = matrix * x; returns the dot products of the two per channel.
  Eigen::Array4d multiply(const Vector& x, Vector& product);
  /// The inverse of the wedge's own 4 x 4 block.
  const Eigen::Matrix4f& inverse_block(int wedge) const { return inverse_blocks_[wedge]; }

  Vector right_hand_side;

 private:
  void assemble(const PatchMesh& patches, const Raster& picture, double regularization,
                const RunContext& context);
  void invert_blocks();
  template <class Body>
  void for_each_group(const Body& body);

  int channels_;
  WedgeCorners wedge_corners_;
  std::vector<ElementGroup> groups_;
  std::vector<CornerUnknowns> scratch_;  // per patch, and for the empty places of the last group
  std::vector<Eigen::Matrix4f> inverse_blocks_;
};

}  // namespace quadrille
