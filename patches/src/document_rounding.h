#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "document_quantization.h"

namespace quadrille {

/// The four kinds of a wedge, all channels, in the units that color_step_of() divides.
using LocalColors = std::array<Eigen::Array4d, 4>;

/// Codes whose rendered picture is close to that of the exact colours: every wedge is rounded to
/// the nearest plane (Babai, "On Lovasz' lattice reduction and the nearest lattice point problem",
/// 1986) in the metric of the rendered picture, given the errors of its neighbours, in several
/// sweeps. Separate rounding would leave half as much squared error again. Exact codes come back
/// unchanged.
std::vector<WedgeCode> round_colors(const PatchMesh& patches, const std::vector<ColorFrame>& frames,
                                    const std::vector<LocalColors>& exact, double color_step);

}  // namespace quadrille
