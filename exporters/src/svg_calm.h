#pragma once

#include "svg_layer.h"

namespace quadrille {

/// What a squared error in the paint of the layer counts, about 1 in photographs: up to four times
/// as much where colours hardly bend within the patches, since nothing hides the bands of a
/// gradient there.
double banding_weight(const SvgLayer& layer);

}  // namespace quadrille
