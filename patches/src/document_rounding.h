#pragma once

#include <vector>

#include "document_metric.h"

namespace quadrille {

/// Codes whose rendered picture is close to that of the exact colours: every wedge is rounded to
/// the nearest plane (Babai, "On Lovasz' lattice reduction and the nearest lattice point problem",
/// 1986) in the metric of the rendered picture, given the errors of its neighbours, in several
/// sweeps. Separate rounding would leave half as much squared error again. Exact codes come back
/// unchanged.
std::vector<WedgeCode> round_colors(const PatchMesh& patches, const PictureMetric& metric,
                                    const std::vector<LocalColors>& exact, const ColorSteps& steps);

}  // namespace quadrille
