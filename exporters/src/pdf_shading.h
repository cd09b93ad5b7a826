#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "paint_groups.h"
#include "pdf_cells.h"
#include "pdf_order.h"
#include "pdf_scratch.h"

namespace quadrille {

/// The whole numbers that stand for coordinates in a shading: pixel = origin + unit * number.
struct CoordinateGrid {
  Eigen::Vector2d origin{0, 0};
  double unit = 1;
  int bits = 16;

  /// Covers the box with 16 bits in steps of 1/16 pixel; with 24 bits, finer, where that is too
  /// short.
  static CoordinateGrid covering(const Eigen::AlignedBox2d& box);

  double largest(int axis) const;  ///< pixel that the greatest number stands for
};

/// The data of a Coons patch mesh (shading type 6; ISO 32000-1, 8.7.4.5.7), with 8-bit flags and
/// components, deflated with predictor 12 over records of `record_bytes`.
struct CoonsShading {
  ScratchRange data;
  int record_bytes = 0;
  int channels = 3;
  bool empty() const { return data.empty(); }
};

/// The cells of these visits. A patch with Adini's twists is the Coons patch of its sides, and so
/// is any rectangle of its parameters: the geometry is exact up to the grid.
///
/// Patches overlap by an eighth of a pixel, lest viewers leave gaps where neighbours are divided
/// differently, and go on beyond tears and the outline, where regions cut them off.
CoonsShading coons_shading(const Layer& layer, const PaintGroups& groups,
                           const std::vector<PatchVisit>& visits, const CellTable& cells,
                           const CoordinateGrid& grid, ShadedQuantity quantity,
                           ScratchFile& scratch, const std::function<void(double)>& progress);

}  // namespace quadrille
