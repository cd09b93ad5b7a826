#pragma once

#include "quadrille/vectorize.h"

namespace quadrille {

/// Squared distance of the premultiplied colours of each pixel.
FieldGrid<float> squared_error(const Raster& shown, const Raster& fitted);

/// How many times as many quads per area the error asks for, at the working pixels.
FieldGrid<float> error_density(const Quadrangulation& quads, const FieldGrid<float>& error);

}  // namespace quadrille
