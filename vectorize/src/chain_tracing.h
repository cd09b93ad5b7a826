#pragma once

#include <Eigen/Core>
#include <vector>

#include "boundary_graph.h"
#include "premultiplied_colours.h"
#include "quadrille/feature_chains.h"

namespace quadrille {

/// The runs of a graph's arcs that are sufficiently strong and sharp, as arcs between the graph's
/// nodes and new ones at free ends. `gradient` is the norm of the gradient per cell, `cell` the
/// size of the cells in source pixels.
BoundaryGraph strong_runs(const PremultipliedColours& colours, const BoundaryGraph& graph,
                          const FieldGrid<float>& gradient, double cell,
                          const ChainOptions& options, const RunContext& context);

/// An arc moved to where the edge is.
struct TracedChain {
  std::vector<Eigen::Vector2d> points;  ///< on the edge, clear of the nodes; source pixels
  int from = -1, to = -1;               ///< nodes of the graph
  double contrast = 0, sharpness = 0;   ///< means
};
std::vector<TracedChain> traced_chains(const PremultipliedColours& colours,
                                       const BoundaryGraph& graph, double cell,
                                       const RunContext& context);

}  // namespace quadrille
