#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lattice_graph.h"
#include "quadrille/feature_chains.h"

namespace quadrille {

/// The wished length at a place of mesh edges in the direction of a unit vector, source pixels.
using DirectedSpacing = std::function<double(const Eigen::Vector2d&, const Eigen::Vector2d&)>;

/// The radius of the ellipse whose half axes are the cross's arms in that direction. The fields
/// must outlive the result; `scale_x` and `scale_y` are the sizes of a working pixel.
DirectedSpacing directed_spacing(const CrossField& field, const ScaleField& scale, double scale_x,
                                 double scale_y);

/// The vertices that the mesh gets on chains, and the curves' pieces between them.
struct ChainSamples {
  struct Piece {
    int chain;
    double from, to;  ///< arc lengths
    int a, b;         ///< points
  };
  std::vector<Eigen::Vector2d> points;  ///< source pixels; the network's nodes first
  std::vector<Piece> pieces;            ///< along each chain
  /// Per lattice point the sample that takes its place, -1 when no chain is near, -2 when it is too
  /// near to a chain but not to a sample.
  std::vector<int> sample_of_lattice_point;
  std::vector<std::vector<int>> neighbours;  ///< of each point along the chains

  /// True when chains lead from one point to another in at most three steps, so that an edge
  /// between them could cut off a face without inner vertices, flat where the chain is smooth.
  bool is_ear(int a, int b) const;
};
inline constexpr int kNoSample = -1, kInTheWay = -2;

/// Nodes first, then lattice points near the chains, projected and merged where closer together
/// than half a spacing, then whatever is needed for edges of about the spacing that follow the
/// chains. `graph` is in source pixels.
ChainSamples sample_chains(const ChainNetwork& network, const LatticeGraph& graph,
                           const DirectedSpacing& spacing, double width, double height);

}  // namespace quadrille
