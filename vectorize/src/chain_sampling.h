#pragma once

#include <Eigen/Core>
#include <vector>

#include "contour.h"
#include "lattice_graph.h"
#include "quadrille/feature_chains.h"

namespace quadrille {

/// A curve between two nodes of a chain network, by arc length.
class ChainCurve {
 public:
  explicit ChainCurve(const std::vector<Eigen::Vector2d>& points);
  double length() const { return arc_.back(); }
  Eigen::Vector2d at(double s) const;

 private:
  const std::vector<Eigen::Vector2d>& points_;
  std::vector<double> arc_;  // of each point
};

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
};
inline constexpr int kNoSample = -1, kInTheWay = -2;

/// Nodes first, then lattice points near the chains, projected and merged where closer together
/// than half a spacing, then whatever is needed for edges of about the spacing that follow the
/// chains. `graph` is in source pixels.
ChainSamples sample_chains(const ChainNetwork& network, const LatticeGraph& graph,
                           const Spacing& spacing, double width, double height);

}  // namespace quadrille
