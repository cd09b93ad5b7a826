#pragma once

#include "quadrille/vectorize.h"

namespace quadrille {

/// Pixels on either side whose error a chain answers for.
inline constexpr double kBesideChain = 2;

/// Keeps the chains beside which there is at least `least_gain` times as much squared error per
/// vertex as in the mesh on average, and notes that error as their gain. A mesh has so many
/// `vertices`; along chains one at every `spacing`.
void keep_worthwhile(ChainNetwork& network, const FieldGrid<float>& error, double spacing,
                     double vertices, double least_gain);

/// Leaves out the chains that pass quads with a bad corner within `reach`; false when there are
/// none.
bool leave_out_bad_chains(Quadrangulation& quads, double reach);

}  // namespace quadrille
