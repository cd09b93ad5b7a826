#pragma once

#include <vector>

#include "quadrille/fit.h"
#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

struct OptimizeOptions {
  int rounds = 8;  ///< Gauss-Newton steps that are tried; 0 leaves the patches alone
  /// Weight of well-shaped quads beside the error, not negative: about 0.02 for the smallest error,
  /// 0.12 for quads that are pleasant to edit.
  double shape_weight = 0.02;
  /// Smallest scaled Jacobian that moves may leave behind, in (0, 1); worse quads do not get worse.
  double min_scaled_jacobian = 0.2;
};

/// Throws Error{invalid_argument} for options outside their ranges, as optimize_vertices() does.
void check_options(const OptimizeOptions& options);

/// One step that was tried.
struct OptimizeRound {
  bool accepted = false;
  double mse = 0;            ///< afterwards, if accepted
  int joint_iterations = 0;  ///< of the conjugate gradients for colours and positions
  int color_iterations = 0;  ///< of those for the colours on the new mesh
};

struct OptimizeReport {
  std::vector<OptimizeRound> rounds;
  int accepted = 0;
  /// Mean squared error of the unclamped colours at the pixel centres over pixels and channels,
  /// sRGB in [0, 1], alpha premultiplied; 0 when no round was taken. Afterwards as the
  /// least-squares fit leaves it, before a bound on overshoot.
  double mse_before = 0, mse_after = 0;
  FitReport fit;  ///< of the colours at last; when no step was accepted they stay
};

/// Moves the vertices so that the patches, with the colours that fit best, reproduce the picture
/// better, by joint Gauss-Newton steps on colours and positions with the damping of Levenberg and
/// Marquardt (Nocedal, Wright, Numerical Optimization, section 10.3). The derivative by a position
/// is the central difference of the mean of the picture and what the patches show, tears
/// box-filtered as render() does, so that their jumps count. A step is
/// taken when it lowers the squared error plus the fit's own terms plus 0.16 `shape_weight` r n E.
/// r is the root of the mean squared error at the start, n the mean number of pixel centres in a
/// quad, and E the sum over all corners of (|a|^2 + |b|^2) / (2 det(a, b)), where a and b are the
/// sides that meet there (MIPS energy; Hormann, Greiner 2000).
///
/// Connectivity, tears and the region that the mesh covers stay: border vertices slide along
/// straight axis-parallel borders or stay; vertices inside a chain of tears slide along it, its
/// ends and junctions stay. Tangents are set anew by set_bessel_tangents() and guard_folds().
/// Colours minimise what fit_colors() minimises; the regularization pulls toward those of the round
/// before, and as every fit starts there, the fit's tolerance counts as at least 1e-2. The number
/// of iterations does not depend on the size of the picture. The same bits for any thread count.
///
/// Colours that do not minimise the error (FitMethod::bessel) gain nothing from it, so for them no
/// round is taken; neither is one where no patch contains a pixel centre. The patches come from
/// fit_colors() with the same picture and any method. Throws what that throws, and
/// Error{invalid_argument} for options outside their ranges, and, where rounds are to be taken, for
/// quads that are not strictly convex, whose shape energy is infinite.
OptimizeReport optimize_vertices(PatchMesh& patches, const Raster& picture,
                                 const OptimizeOptions& options = {}, const FitOptions& fit = {},
                                 const RunContext& context = {});

}  // namespace quadrille
