#pragma once

#include <string>
#include <vector>

#include "paint_groups.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// The loops of edges as a path of m, l, c and h, in whole numbers of 1 / units pixel.
std::string region_path(const Layer& layer, const std::vector<EdgeLoop>& loops, int units);
/// Each edge on its own.
std::string edges_path(const Layer& layer, const std::vector<int>& halfedges, int units);

}  // namespace quadrille
