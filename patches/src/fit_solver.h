#pragma once

#include "fit_system.h"
#include "quadrille/fit.h"

namespace quadrille {

/// Throws Error{invalid_argument} where fit_colors() does.
void check_fit(const PatchMesh& patches, const Raster& picture, const FitOptions& options);

/// Solves the system by conjugate gradients with a block-Jacobi preconditioner, all channels side
/// by side (Saad, Iterative Methods for Sparse Linear Systems, algorithm 9.1). Stops when the
/// residual, measured by the preconditioner over all channels, has fallen by options.tolerance.
ColorSystem::Vector solve(ColorSystem& system, const FitOptions& options, const RunContext& context,
                          FitReport& report);

}  // namespace quadrille
