#include "placed_grid.h"

#include "subdivision.h"

namespace quadrille {
namespace {

/// The patch with u along the half-edge of side k, and v from there inward.
template <class T>
BicubicBezier<T> seen_from_side(const BicubicBezier<T>& patch, int k) {
  BicubicBezier<T> result;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int from[4][2] = {{j, i}, {i, 3 - j}, {3 - j, 3 - i}, {3 - i, j}};
      result.control[j][i] = patch.control[from[k][0]][from[k][1]];
    }
  }
  return result;
}

}  // namespace

PlacedGrid::PlacedGrid(const Layer& layer, const QuadGrid& grid)
    : columns_(grid.columns), rows_(grid.rows) {
  for (const int h : grid.tops) {
    const int q = QuadMesh::quad_of(h), k = QuadMesh::corner_of(h);
    positions_.push_back(seen_from_side(to_bezier(placed_geometry(layer, q)), k));
    colors_.push_back(seen_from_side(to_bezier(ferguson_patch(layer.patches, q).color), k));
  }
}

}  // namespace quadrille
