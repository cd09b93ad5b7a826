#pragma once

#include <vector>

#include "svg_layer.h"
#include "svg_outline.h"

namespace quadrille {

/// A group of neighbouring opaque patches in their mean colour.
struct UnderlayGroup {
  std::vector<SvgOutline> outlines;  ///< around the group and its holes
  Eigen::Array3d color;              ///< 0 to 255
};

/// Groups of patches to be painted below all cells of the layer: where the bleed of cells in thin
/// or strongly curved patches falls short, a seam then shows a similar colour and not the
/// background. Patches on the outline of the mesh stay out, whose half-covered pixels would be
/// covered twice. Tears separate groups.
std::vector<UnderlayGroup> underlay_groups(const SvgLayer& layer, double width, double height);

}  // namespace quadrille
