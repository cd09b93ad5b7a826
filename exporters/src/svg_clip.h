#pragma once

#include "paint_groups.h"
#include "svg_outline.h"

namespace quadrille {

/// The exact outline along a loop of edges, to clip with.
SvgOutline clip_outline(const Layer& layer, const EdgeLoop& loop);

}  // namespace quadrille
