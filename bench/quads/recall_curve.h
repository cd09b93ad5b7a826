#pragma once

#include <vector>

#include "boundary_recall.h"
#include "quadrille/raster.h"

namespace quadrille::bench {

/// A segmentation's score with the number of its cells.
struct RecallPoint {
  double cells = 0;
  BoundaryScore score;
};

/// Scores of one method from coarse to fine.
class RecallCurve {
 public:
  explicit RecallCurve(std::vector<RecallPoint> coarse_to_fine)
      : points_(std::move(coarse_to_fine)) {}

  /// Linear between the neighbouring points, the end points beyond them.
  RecallPoint at_cells(double cells) const;
  RecallPoint at_density(double density) const;

 private:
  std::vector<RecallPoint> points_;
};

/// SLIC with one compactness and cells from 64 to 5 pixels wide; empty when SLIC is not built.
std::vector<RecallPoint> slic_points(const Raster& picture,
                                     const std::vector<BoundaryMask>& annotations, float ruler);

}  // namespace quadrille::bench
