#pragma once

#include <functional>
#include <vector>

#include "svg_cell_mesh.h"
#include "svg_outline.h"

namespace quadrille {

/// Farthest that lines may be from seams, in pixels.
inline constexpr double kSeamFlatness = 0.2;

/// A group of cells as it is painted.
struct CellGroup {
  std::vector<int> cells;
  std::function<bool(int)> holds;     ///< whether a cell is in the group
  std::function<bool(int)> is_later;  ///< whether a cell is painted after the group
};

/// The outlines around a group of cells and its holes with their bleed: wherever the group borders
/// on something that is painted later, it goes on underneath by `bleed` pixels, and a little
/// further beyond a clip. Toward whatever else is painted earlier it ends exactly, across tears at
/// corners too, where it is exact to 0.04 pixels. Without bleed,
/// anti-aliased cells let the background shine through along their seams; where several end in one
/// pixel of an outline, their shares of it would not add up. Holes that later cells fill are left
/// out. No bleed gives the group's own outlines.
std::vector<SvgOutline> group_outlines(const CellMesh& mesh, const CellGroup& group, double bleed);

}  // namespace quadrille
