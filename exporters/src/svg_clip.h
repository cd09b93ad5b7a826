#pragma once

#include "paint_groups.h"
#include "svg_outline.h"

namespace quadrille {

/// True when both ends lie on the same side of the rectangle [0, width] x [0, height].
bool is_on_a_side(const PlaneCurve& curve, double width, double height);

/// True when the border of the layer's mesh is that of the picture, at which every viewer clips.
bool fills_picture(const Layer& layer, double width, double height);

/// The exact outline along a loop of edges, to clip with.
SvgOutline clip_outline(const Layer& layer, const EdgeLoop& loop);

}  // namespace quadrille
