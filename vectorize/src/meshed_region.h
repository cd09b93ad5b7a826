#pragma once

#include <vector>

#include "quadrille/vectorize.h"

namespace quadrille {

/// The outline to follow with so many quads: empty for the whole picture.
std::vector<Loop> wanted_outline(const Raster& picture, const VectorizeOptions& options);

/// Area of the part of the picture that is meshed, in square pixels.
double region_area(const std::vector<Loop>& outline, const Raster& picture);

/// The share of the lattice's cells that lies inside the outline.
double share_of_cells(const std::vector<Loop>& outline, const WorkingPicture& working,
                      const ScaleField& scale);

}  // namespace quadrille
