#pragma once

#include <vector>

#include "svg_cells.h"
#include "svg_detail.h"
#include "svg_gradient.h"
#include "svg_layer.h"
#include "svg_outline.h"

namespace quadrille {

/// Something that is painted at once.
struct SvgPaint {
  std::vector<SvgOutline> outlines;
  CellFill fill;
};

/// The paint of some patches, in its order.
/// The patches are all those of one or several tiles of the layer. Works on several threads.
std::vector<SvgPaint> paint_patches(const SvgLayer& layer, const std::vector<int>& quads,
                                    CellPaint paint, const SvgDetail& detail);

}  // namespace quadrille
