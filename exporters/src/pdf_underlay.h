#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "paint_groups.h"
#include "pdf_cells.h"

namespace quadrille {

/// A small RGB image, 8 bits per channel, over a box of the picture, rows from the top.
struct Underlay {
  Eigen::AlignedBox2d box;
  int width = 0, height = 0;
  std::string rgb;
  bool empty() const { return rgb.empty(); }
};

/// The colours of the patches of all groups with about one pixel per patch that has cells, to lie
/// beneath them: viewers round the corners of cells and straighten their sides, and leave pixels
/// open here and there. Empty when nothing is painted.
Underlay underlay(const Layer& layer, const PaintGroups& groups, const CellTable& cells,
                  const Eigen::AlignedBox2d& box);

}  // namespace quadrille
