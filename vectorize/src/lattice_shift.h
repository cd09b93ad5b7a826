#pragma once

#include "lattice_frame.h"
#include "metric_field.h"

namespace quadrille {

/// A lattice known by one of its points.
struct LatticePoint {
  float angle;       ///< of the axis that `lengths.x` belongs to, radians
  AxisPair lengths;  ///< of the lattice's edges
  Eigen::Vector2f origin;
};

/// The integer steps from i's lattice point to j's, along the axes of i, in the mean of the two
/// lattices.
inline Eigen::Vector2i shift_between(const LatticePoint& i, const LatticePoint& j) {
  const CrossMatching matching(i.angle, j.angle);
  const float jx = matching.swapped ? j.lengths.y : j.lengths.x;
  const float jy = matching.swapped ? j.lengths.x : j.lengths.y;
  const LatticeFrame frame(i.angle + 0.5f * matching.turn, 0.5f * (i.lengths.x + jx),
                           0.5f * (i.lengths.y + jy));
  const Eigen::Vector2f shift = frame.to_lattice(j.origin - i.origin);
  return {static_cast<int>(std::lround(shift.x())), static_cast<int>(std::lround(shift.y()))};
}

}  // namespace quadrille
