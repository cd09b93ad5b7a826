#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contour.h"
#include "lattice_graph.h"

namespace quadrille {

/// The vertices that the mesh gets on an outline. Points and midpoints are multiples of 1/64 pixel,
/// and the loops of points are simple, disjoint and nested like the outline's.
struct OutlineSamples {
  std::vector<Eigen::Vector2d> points;     ///< source pixels
  std::vector<std::array<int, 2>> edges;   ///< between them, the inside on the positive side
  std::vector<Eigen::Vector2d> midpoints;  ///< of the outline between the ends of each edge
  /// Per lattice point the sample that takes its place, -1 when it is too far from the outline.
  std::vector<int> sample_of_lattice_point;
};

/// Marks first (see Contour), then lattice points within half a spacing of the outline, projected
/// and merged where closer than that, then whatever is needed for edges of about the spacing that
/// follow the outline. `graph` is in source pixels.
OutlineSamples sample_outline(const std::vector<Loop>& outline, const LatticeGraph& graph,
                              const Spacing& spacing, double width, double height);

}  // namespace quadrille
