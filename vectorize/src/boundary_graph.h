#pragma once

#include <Eigen/Core>
#include <vector>

#include "quadrille/field_grid.h"

namespace quadrille {

/// The lines between the areas of a label map, in cells: corners of cells where more or less than
/// two lines meet are nodes, the lines between nodes are arcs.
struct BoundaryGraph {
  struct Arc {
    /// Corners of cells along the line, both nodes included; a line without nodes starts and ends
    /// at one of its corners.
    std::vector<Eigen::Vector2i> corners;
    int from = -1, to = -1;  ///< nodes; the same number for a loop
  };
  std::vector<Eigen::Vector2i> nodes;
  std::vector<Arc> arcs;
};

BoundaryGraph boundary_graph(const FieldGrid<int>& labels);

/// Joins the two arcs of each node where two end.
void join_pairs(BoundaryGraph& graph);

/// Leaves out arcs with a free end, a node where nothing else ends and that `is_anchored` does not
/// hold, that have fewer than `least_corners`; then joins pairs.
void simplify(BoundaryGraph& graph, std::size_t least_corners,
              const std::vector<char>& is_anchored);

}  // namespace quadrille
