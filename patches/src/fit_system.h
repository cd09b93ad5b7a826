#pragma once

#include <vector>

#include "fit_element.h"
#include "fit_solver.h"
#include "mixed_pixels.h"
#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "wedge_corners.h"

namespace quadrille {

/// The normal equations of fitting a correction to the colours that a PatchMesh has: unknowns per
/// wedge, one equation per pixel: at its centre element by element, or a mixture near tears. It
/// runs in the caller's tbb arena.
class ColorSystem : public NormalEquations {
 public:
  /// Scans the picture. The correction is damped as if every square pixel had another equation of
  /// weight `regularization` that asks for no correction.
  ColorSystem(const PatchMesh& patches, const Raster& picture, double regularization,
              const RunContext& context);

  Eigen::Array4d multiply(const Vector& x, Vector& product) override;
  const Eigen::Matrix4f& inverse_block(int wedge) const override { return inverse_blocks_[wedge]; }

 private:
  void assemble(const PatchMesh& patches, const Raster& picture, double regularization,
                const RunContext& context);
  void invert_blocks();

  std::vector<int> wedge_of_corner_;
  WedgeCorners wedge_corners_;
  MixedPixels mixed_;
  std::vector<PatchElement> elements_;
  std::vector<CornerUnknowns> scratch_;  // per patch
  std::vector<Eigen::Matrix4f> inverse_blocks_;
};

}  // namespace quadrille
