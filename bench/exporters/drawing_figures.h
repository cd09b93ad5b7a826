#pragma once

#include <nlohmann/json.hpp>

#include "quadrille/raster.h"

namespace quadrille::bench {

/// How far a drawing of a file is from the reference. `psnr`: dB over white, the squared error of
/// the whole drawing spread over the pixels inside the picture, where the reference's alpha is
/// above 0; at most 99. `edge_mae`: see edge_error(). Where the reference is opaque: `leak_mean`
/// and `leak_max`, how far the drawing's alpha (0 to 255) falls short of 255 more than 2 pixels
/// away from the outline and the frame, and `border_max`, the same of all those pixels.
nlohmann::ordered_json drawing_figures(const Raster& reference, const Raster& drawing);

}  // namespace quadrille::bench
