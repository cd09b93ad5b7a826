#pragma once

#include <Eigen/Geometry>

#include "lanes.h"
#include "patch_inverse.h"

namespace quadrille {

/// A patch's geometry in power basis as plain floats: 4 j + i weighs u^i v^j.
struct GeometryCoefficients {
  float map[2][3];  ///< given points to normalized ones: x = map[0][0] x + map[0][1] y + map[0][2]
  float start[2][6];  ///< see NormalizedPatch
  float position[2][16];
};

/// The normalized patch as floats; `map` takes given points to normalized ones.
GeometryCoefficients geometry_coefficients(const NormalizedPatch& normalized,
                                           const Eigen::Affine2d& map);

/// Points in, parameters out; arrays have `count` elements, a multiple of kLaneCount.
struct PointBatch {
  int count;
  const float *x, *y;
  float *u, *v;
  int* found;  ///< not 0 where the point's parameters were found in or next to the patch
};

/// Inverts the geometry by Newton's method, kLaneCount points at a time. A lane stops moving when
/// it has converged, so no point's result depends on another's; all instruction sets give the same
/// bits.
void invert_lanes(const GeometryCoefficients& c, const PointBatch& batch);

}  // namespace quadrille
