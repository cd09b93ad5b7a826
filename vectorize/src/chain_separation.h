#pragma once

#include "quadrille/feature_chains.h"

namespace quadrille {

/// Cuts out the pieces of chains that come nearer than `distance` pixels to a stronger chain, other
/// than beside a node that both share, and leaves out the pieces between that are shorter than
/// `min_length`. Chains that meet at less than about 20 degrees part after a while.
void separate_chains(ChainNetwork& network, double distance, double min_length);

}  // namespace quadrille
