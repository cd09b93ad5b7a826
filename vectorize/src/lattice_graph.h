#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "quadrille/position_field.h"

namespace quadrille {

/// The lattice that the position field describes: its points and the edges between neighbours, in
/// working pixels unless scaled(). Points that belong to a side or a corner of the picture lie on
/// it exactly.
struct LatticeGraph {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> spacing;            ///< smallest wished edge length at each point
  std::vector<std::array<int, 2>> edges;  ///< most certain first
};

/// The same graph with lengths in source pixels.
LatticeGraph scaled(LatticeGraph graph, double scale_x, double scale_y);

/// Grid units per source pixel for an exact triangulation of the graph: a power of two, so that
/// multiples of 1/64 pixel stay exact both ways, and small enough for the grid's predicates.
double units_per_pixel(const LatticeGraph& graph, double width, double height);

/// Pixels whose lattice points are shifted by nothing form a region, a region makes a point (the
/// mean of its lattice points, features weighted up), and two regions that mostly touch with a
/// shift of one along one axis make an edge. Fragments and points closer than half the spacing to a
/// better one are dropped; the picture's four corners are always points.
LatticeGraph lattice_graph(const FeatureTensor& features, const CrossField& field,
                           const ScaleField& scale, const PositionField& positions);

}  // namespace quadrille
