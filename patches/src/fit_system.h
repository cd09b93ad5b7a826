#pragma once

#include <vector>

#include "element_lanes.h"
#include "fit_lanes.h"
#include "patch_samples.h"
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
  /// weight `regularization` that asks for no correction. With `keep` the samples are left there.
  ColorSystem(const PatchMesh& patches, const Raster& picture, double regularization,
              const RunContext& context, std::vector<SampleBlock>* keep = nullptr);

  int wedge_count() const { return static_cast<int>(right_hand_side.size()); }

  /// product = matrix * x; returns the dot products of the two per channel.
  Eigen::Array4d multiply(const Vector& x, Vector& product);
  /// The inverse of the wedge's own 4 x 4 block.
  const Eigen::Matrix4f& inverse_block(int wedge) const { return inverse_blocks_[wedge]; }

  int channels() const { return channels_; }
  const WedgeCorners& wedge_corners() const { return wedge_corners_; }
  /// Patch q has place q % kLaneCount of group q / kLaneCount.
  const std::vector<ElementGroup>& groups() const { return groups_; }

  Vector right_hand_side;

 private:
  void assemble(const PatchMesh& patches, const Raster& picture, double regularization,
                const RunContext& context, std::vector<SampleBlock>* keep);
  void invert_blocks();
  template <class Body>
  void for_each_group(const Body& body);

  int channels_;
  WedgeCorners wedge_corners_;
  std::vector<ElementGroup> groups_;
  std::vector<CornerUnknowns> scratch_;  // per patch, and for the empty places of the last group
  std::vector<Eigen::Matrix4f> inverse_blocks_;
};

/// Bezier form of the colours that patch q has; `corners` are its corner_maps().
void control_colors(const PatchMesh& patches, int q, const std::array<CornerMap, 4>& corners,
                    ControlColors& control);

void add_correction(const ColorSystem::Vector& correction, std::vector<Wedge>& wedges);

}  // namespace quadrille
