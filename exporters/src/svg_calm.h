#pragma once

#include <vector>

#include "svg_layer.h"

namespace quadrille {

/// What an error in the paint of these patches counts: more where their colours hardly bend, since
/// nothing hides the bands of a gradient there.
double banding_weight(const SvgLayer& layer, const std::vector<int>& quads);

}  // namespace quadrille
