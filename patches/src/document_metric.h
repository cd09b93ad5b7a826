#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "document_quantization.h"
#include "wedge_corners.h"

namespace quadrille {

/// Colours of a patch: number 4 k + i is the value, u, v or mixed derivative i of corner k.
using PatchColors = std::array<Eigen::Array4d, 16>;

/// The squared error of the drawn picture as a quadratic form of the errors of the wedges' colours:
/// the sum over all patches of area times the integral over (u, v), channel by channel.
class PictureMetric {
 public:
  PictureMetric(const PatchMesh& patches, const std::vector<ColorFrame>& frames);

  const WedgeCorners& corners() const { return corners_; }
  int wedge_count() const { return static_cast<int>(block_.size()); }
  int patch_count() const { return static_cast<int>(area_.size()); }

  double area(int patch) const { return area_[patch]; }

  /// Part of the form for one wedge, and its Cholesky factor: block = root^T root.
  const Eigen::Matrix4d& block(int wedge) const { return block_[wedge]; }
  const Eigen::Matrix4d& root(int wedge) const { return root_[wedge]; }
  /// block^-1 x.
  LocalColors solve_block(int wedge, LocalColors x) const;

  /// Sets the four colours of corner h in those of its patch.
  void put(int h, const LocalColors& wedge, PatchColors& patch) const;
  /// Adds what the patch's colours say about those of the wedge at corner h: the form's product.
  void add_product(int h, const PatchColors& patch, LocalColors& wedge) const;
  /// Integrals of the patch's colours times its basis.
  static PatchColors products(const PatchColors& patch);
  /// Adds the integrals of a function times the functions of the wedge at corner h; `integrals` are
  /// those with the patch's basis.
  void add_integrals(int h, const PatchColors& integrals, LocalColors& wedge) const;

 private:
  WedgeCorners corners_;
  std::vector<Eigen::Matrix4d> to_patch_;  ///< per corner: kinds -> colours of the patch
  std::vector<double> area_;               ///< per patch
  std::vector<Eigen::Matrix4d> block_, root_;

  void measure(const PatchMesh& patches, const std::vector<ColorFrame>& frames, int q);
};

}  // namespace quadrille
