#pragma once

#include "quadrille/fit.h"

namespace quadrille {

/// Corrects fitted colours where they leave their range by more than options.max_overshoot, and
/// adds the iterations to the report. Runs in the caller's tbb arena.
void limit_overshoot(PatchMesh& patches, const Raster& picture, const FitOptions& options,
                     const RunContext& context, FitReport& report);

}  // namespace quadrille
