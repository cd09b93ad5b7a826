#pragma once

#include <vector>

#include "element_lanes.h"
#include "fit_lanes.h"
#include "fit_solver.h"
#include "mixed_pixels.h"
#include "overshoot.h"
#include "patch_samples.h"
#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "wedge_corners.h"

namespace quadrille {

/// The normal equations of fitting a correction to the colours that a PatchMesh has: unknowns per
/// wedge, one equation per pixel: at its centre element by element, or a mixture near tears; and
/// those that ask for smoothness. It runs in the caller's tbb arena.
class ColorSystem : public NormalEquations {
 public:
  /// Scans the picture. The correction is damped as if every square pixel had another equation of
  /// weight options.regularization that asks for no correction. With `keep` the samples are left
  /// there, or taken from there when it holds those of the same geometry. The equations of
  /// `overshoot` are added to the others.
  ColorSystem(const PatchMesh& patches, const Raster& picture, const FitOptions& options,
              const RunContext& context, std::vector<SampleBlock>* keep = nullptr,
              const Overshoot& overshoot = {});

  Eigen::Array4d multiply(const Vector& x, Vector& product) override;
  const Eigen::Matrix4f& inverse_block(int wedge) const override { return inverse_blocks_[wedge]; }

  /// product = the patches' shares, added up at the wedges, and those of the other equations for x;
  /// returns the dot products with x per channel.
  Eigen::Array4d gather(const Vector& x, const std::vector<CornerUnknowns>& shares,
                        Vector& product);

  int channels() const { return channels_; }
  const WedgeCorners& wedge_corners() const { return wedge_corners_; }
  const MixedPixels& mixed_pixels() const { return mixed_; }
  /// Those of the mixed pixels first, then what asks for smoothness and against overshoot.
  const WedgeRows& rows() const { return rows_; }
  /// Patch q has place q % kLaneCount of group q / kLaneCount.
  const std::vector<ElementGroup>& groups() const { return groups_; }

 private:
  /// The scan has one sample per pixel.
  ColorSystem(const PatchScan& scan, const Raster& picture, const FitOptions& options,
              const RunContext& context, std::vector<SampleBlock>* keep,
              const Overshoot& overshoot);
  void assemble(const PatchScan& scan, const Raster& picture, double regularization,
                const RunContext& context, std::vector<SampleBlock>* keep);
  void invert_blocks();
  template <class Body>
  void for_each_group(const Body& body);

  int channels_;
  WedgeCorners wedge_corners_;
  WedgeRows rows_;
  MixedPixels mixed_;
  std::vector<ElementGroup> groups_;
  std::vector<CornerUnknowns> scratch_;  // per patch, and for the empty places of the last group
  std::vector<Eigen::Matrix4f> inverse_blocks_;
};

/// Bezier form of the colours that patch q has; `corners` are its corner_maps().
void control_colors(const PatchMesh& patches, int q, const std::array<CornerMap, 4>& corners,
                    ControlColors& control);

void add_correction(const ColorSystem::Vector& correction, std::vector<Wedge>& wedges);

}  // namespace quadrille
