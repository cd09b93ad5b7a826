#pragma once

#include <vector>

#include "fit_element.h"
#include "quadrille/fit.h"

namespace quadrille {

/// Throws Error{invalid_argument} where fit_colors() does.
void check_fit(const PatchMesh& patches, const Raster& picture, const FitOptions& options);

/// Normal equations with up to four unknowns per wedge and channel.
class NormalEquations {
 public:
  using Vector = std::vector<WedgeUnknowns>;

  virtual ~NormalEquations() = default;

  int wedge_count() const { return static_cast<int>(right_hand_side.size()); }
  /// product = matrix * x; returns the dot products of the two per channel.
  virtual Eigen::Array4d multiply(const Vector& x, Vector& product) = 0;
  /// The inverse of the wedge's own 4 x 4 block, or of what stands for it; zero for unknowns that
  /// are to stay zero.
  virtual const Eigen::Matrix4f& inverse_block(int wedge) const = 0;

  Vector right_hand_side;
};

/// Solves the system by conjugate gradients with a block-Jacobi preconditioner, all channels side
/// by side (Saad, Iterative Methods for Sparse Linear Systems, algorithm 9.1). Stops when the
/// residual, measured by the preconditioner over all channels, has fallen by options.tolerance.
NormalEquations::Vector solve(NormalEquations& system, const FitOptions& options,
                              const RunContext& context, FitReport& report);

}  // namespace quadrille
