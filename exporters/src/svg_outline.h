#pragma once

#include <Eigen/Core>
#include <vector>

#include "subdivision.h"
#include "svg_layer.h"

namespace quadrille {

/// A closed outline: lines and cubics one after another, in pixels of the picture.
struct SvgOutline {
  struct Piece {
    bool is_line;
    Eigen::Vector2d control1, control2;  ///< of a cubic
    Eigen::Vector2d end;
  };
  bool is_exact = false;  ///< runs along the outline of the mesh or a tear: nothing covers its end
  Eigen::Vector2d start = {0, 0};
  std::vector<Piece> pieces;
};

/// The outline of a cell of a patch with its bleed: wherever the cell borders on something that is
/// painted later, it goes on underneath by `bleed` pixels, within the later cells of its own patch
/// and within the later patches beside it and around its corners; and a little further beyond a
/// clip. Toward whatever else is painted earlier it ends exactly. Without bleed, anti-aliased cells
/// let the background shine through along their seams; where several end in one pixel of an
/// outline, their shares of it would not add up.
SvgOutline cell_outline(const SvgLayer& layer, int quad, const ParameterBox& cell, double bleed);

}  // namespace quadrille
