#pragma once

#include <vector>

#include "chain_tracing.h"
#include "quadrille/feature_chains.h"

namespace quadrille {

/// Gives traced chains their nodes: where the lines that end there meet, or on the border of the
/// picture; corners divide chains. `places` are the graph's nodes in source pixels.
ChainNetwork chain_network(const std::vector<TracedChain>& traced,
                           const std::vector<Eigen::Vector2d>& places, double width, double height);

}  // namespace quadrille
