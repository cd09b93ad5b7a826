#pragma once

#include <functional>
#include <span>
#include <vector>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// A part of a mesh that is a lattice: columns x rows quads, row by row.
struct QuadGrid {
  /// Most columns, and most rows.
  static constexpr int kMostPerSide = 32;

  int columns = 0, rows = 0;
  /// Per quad the half-edge that runs along its top from left to right. The one along its left runs
  /// up, the one along its bottom to the left.
  std::vector<int> tops;

  int top(int column, int row) const { return tops[row * columns + column]; }
};

/// The half-edge along the top of the quad to the right of the one whose top is h, and of the quad
/// below; -1 at the border of the mesh.
int right_of(const QuadMesh& mesh, int h);
int below(const QuadMesh& mesh, int h);

/// Cuts the mesh into lattices: the largest that there is (with at most QuadGrid::kMostPerSide
/// quads along a side), the largest of what remains, and so on; of equally large ones the squarer,
/// then the one with the lowest half-edge in its corner. `kinds` has a number per quad: quads of
/// different kinds never share a grid, and those of kind 0 are left out. No grid has a tear, a
/// border or an irregular vertex inside it. A corner is looked at about
/// once, in at most kMostPerSide^2 steps. `progress` gets the completed fraction.
std::vector<QuadGrid> regular_grids(
    const QuadMesh& mesh, std::span<const unsigned char> kinds,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace quadrille
