#pragma once

#include "canvas.h"

namespace quadrille::cli {

/// Draws points, lines, polygons or a grid as the layer's style says; patches are what render()
/// draws.
void draw_layer(Canvas& canvas, const SceneLayer& layer);

}  // namespace quadrille::cli
