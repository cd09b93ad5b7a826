#pragma once

#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// Moves the vertices that only patches without `is_sound` have between the nearest others, and
/// straightens the edges that only such patches have: nothing else changes, and all of the layer's
/// geometry is finite when the sound patches' is.
void settle_geometry(Layer& layer, const std::vector<char>& is_sound);

}  // namespace quadrille
