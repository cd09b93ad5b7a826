#pragma once

#include <Eigen/Core>
#include <array>

#include "power_basis.h"

namespace quadrille {

/// A patch's geometry made ready for inversion: moved to the mean of its corners and divided by its
/// size, in power basis, with a quadratic estimate of the inverse to start from.
struct NormalizedPatch {
  Eigen::Array2d center;
  double size = 1;  ///< larger side of the corners' bounding box, in mesh units
  PowerBasis<Eigen::Array2d> position;
  /// Parameters (u, v) estimated as start[0] + start[1] x + start[2] y + start[3] xx + start[4] xy
  /// + start[5] yy of a normalized point, by least squares over a 3 x 3 grid of parameters.
  std::array<Eigen::Array2d, 6> start;

  explicit NormalizedPatch(const BicubicHermite<Eigen::Vector2d>& geometry);
};

/// Inverse of a patch's geometry: finds the parameters of a point of the plane. Prepared once per
/// patch; each call depends on nothing but the patch and the point.
class PatchInverse {
 public:
  explicit PatchInverse(const BicubicHermite<Eigen::Vector2d>& geometry);

  /// Parameters in [0,1]^2 whose position is p, clamped to the square for points slightly outside
  /// (the outline is scanned as a polyline). For a fold-free patch the residual is below 1e-6 of
  /// the patch's size wherever p lies inside. Other points, and patches that fold, get the
  /// parameters of a nearest position as far as a search of bounded length finds it.
  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const;

 private:
  NormalizedPatch patch_;

  Eigen::Vector2d search(const Eigen::Array2d& target) const;
};

}  // namespace quadrille
