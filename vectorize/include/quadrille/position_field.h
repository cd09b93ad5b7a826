#pragma once

#include <Eigen/Core>

#include "quadrille/cross_field.h"
#include "quadrille/scale_field.h"

namespace quadrille {

/// The lattice point nearest to each working pixel, in working pixels.
struct PositionField {
  FieldGrid<Eigen::Vector2f> origin;
};

struct PositionOptions {
  int sweeps = 4;               ///< smoothing sweeps per level of the hierarchy, >= 0
  double feature_weight = 0.2;  ///< c of the projection onto features, 0 to 1
};

/// Hierarchical smoothing of Eq. 9 over the 8-neighbourhood with intrinsic rounding, border and
/// corner constraints, and the projection of Eq. 10 on features. Throws Error{invalid_argument} for
/// options outside their ranges.
PositionField position_field(const FeatureTensor& features, const CrossField& field,
                             const ScaleField& scale, const PositionOptions& options = {},
                             const RunContext& context = {});

/// The integer shift between the lattice points of two pixels, in the frame of the first:
/// round(S^-1 R^T (o_j - o_i)) with the mean frame of both.
Eigen::Vector2i lattice_shift(const CrossField& field, const ScaleField& scale,
                              const PositionField& positions, int xi, int yi, int xj, int yj);

}  // namespace quadrille
