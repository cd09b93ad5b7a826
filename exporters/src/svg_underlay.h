#pragma once

#include <vector>

#include "svg_layer.h"
#include "svg_outline.h"

namespace quadrille {

/// A group of neighbouring patches in their mean colour.
struct UnderlayGroup {
  std::vector<SvgOutline> outlines;  ///< around the group and its holes
  Eigen::Array3d color;              ///< 0 to 255
};

/// What is painted below all cells of some patches: where the bleed of cells in thin or strongly
/// curved patches falls short, a seam then shows a similar colour and not the background. Tears
/// separate groups.

/// Below the opaque patches. Those on the outline stay out, whose half-covered pixels would be
/// covered twice.
std::vector<UnderlayGroup> opaque_underlay(const SvgLayer& layer, double width, double height);

/// Below the colours of the translucent patches, which a mask ends, and below the opaque ones
/// beside them.
std::vector<UnderlayGroup> translucent_underlay(const SvgLayer& layer);

/// Below the alpha of the translucent patches: white, under those that are nearly opaque and the
/// opaque ones beside them, unless they are on the outline.
UnderlayGroup mask_underlay(const SvgLayer& layer, double width, double height);

}  // namespace quadrille
