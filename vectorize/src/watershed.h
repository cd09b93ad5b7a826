#pragma once

#include "quadrille/field_grid.h"

namespace quadrille {

/// Divides a grid into the catchment basins of its minima, numbered from 0. Every cell belongs to a
/// basin, so that basins border on each other along the ridges (Vincent, Soille, Watersheds in
/// digital spaces, 1991, without their dams; neighbours share a side). In time O(cells).
FieldGrid<int> catchment_basins(const FieldGrid<unsigned char>& height);

/// Makes one of two basins where the shallower one is less deep than `depth` times the height of
/// the lowest pass between them, lowest passes first. The ridge of an anti-aliased edge undulates;
/// its dips are no basins.
FieldGrid<int> merge_shallow_basins(const FieldGrid<unsigned char>& height, FieldGrid<int> basin,
                                    double depth);

}  // namespace quadrille
