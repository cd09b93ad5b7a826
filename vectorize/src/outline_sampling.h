#pragma once

#include <Eigen/Core>
#include <vector>

#include "contour.h"
#include "lattice_graph.h"

namespace quadrille {

/// The vertices that the mesh gets on an outline. Points and midpoints are multiples of 1/64 pixel,
/// and the loops of points are simple, disjoint and nested like the outline's.
struct OutlineSamples {
  std::vector<Eigen::Vector2d> points;     ///< source pixels; loop by loop, the inside on the
                                           ///< positive side of the way from one to the next
  std::vector<Eigen::Vector2d> midpoints;  ///< of the outline between each point and the next
  std::vector<int> loop_of_point;
  std::vector<int> loop_begin;  ///< first point of each loop, and the number of points
  /// Per lattice point the sample that takes its place, -1 when it is too far from the outline.
  std::vector<int> sample_of_lattice_point;

  int loop_size(int loop) const { return loop_begin[loop + 1] - loop_begin[loop]; }
  int next(int p) const {
    return p + 1 < loop_begin[loop_of_point[p] + 1] ? p + 1 : loop_begin[loop_of_point[p]];
  }
  /// How many edges of the outline two points are apart; -1 on different loops.
  int steps_between(int p, int q) const;
};

/// Marks first (see Contour), then lattice points within half a spacing of the outline, projected
/// and merged where closer than that, then whatever is needed for edges of about the spacing that
/// follow the outline. `graph` is in source pixels.
OutlineSamples sample_outline(const std::vector<Loop>& outline, const LatticeGraph& graph,
                              const Spacing& spacing, double width, double height);

}  // namespace quadrille
