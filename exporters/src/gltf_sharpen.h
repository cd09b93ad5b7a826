#pragma once

#include "sheet_texture.h"

namespace quadrille {

/// Makes up for the blur of graphics processors, which show weighted means of neighbouring texels
/// in linear light: subtracts a tenth of the discrete Laplacian there (a prefilter for linear
/// interpolation, as in Blu, Thevenaz, Unser, Linear interpolation revitalized, 2004, by one step
/// instead of a recursion). Plain areas and linear ramps stay as they are.
void sharpen_for_filtering(Texture& texture);

}  // namespace quadrille
