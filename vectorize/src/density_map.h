#pragma once

#include "quadrille/field_grid.h"
#include "quadrille/raster.h"

namespace quadrille {

/// VectorizeOptions::density as ScaleOptions::density: the map's brightness, floored, stretched to
/// width x height pixels. Empty for an empty map and for one that asks for the same everywhere.
/// Throws Error{invalid_argument} for a malformed map.
FieldGrid<float> density_map(const Raster& map, int width, int height);

}  // namespace quadrille
