#pragma once

#include "quadrille/cross_field.h"
#include "quadrille/feature_tensor.h"

namespace quadrille {

/// Edge lengths of the lattice per working pixel, in working pixels, along the cross's two axes
/// (the paper's alpha L and beta L); equal for now.
struct ScaleField {
  FieldGrid<float> along_x;  ///< length along the axis at CrossField::angle
  FieldGrid<float> along_y;  ///< length along the axis at angle + pi/2
};

struct ScaleOptions {
  double min_ratio = 0.4;     ///< a_min: smallest length over the largest, in (0, 1]
  double range = 1.5;         ///< k: distance, in target edges, over which the length grows
  double max_gradient = 0.2;  ///< bound on |grad length|
};

/// alpha = a_min + (1 - a_min) (1 - exp(-(E / kL)^2)) with the exact distance E to the nearest
/// feature line, then gradient-limited and rescaled so that sum 1 / (length_x length_y) is `count`.
/// Replaces the paper's Eq. 5 and 6, whose exp(E^2/v^2) overflows and whose zero divides by zero.
/// Where the cross is aligned with the borders, the lengths divide the sides of the picture.
ScaleField scale_field(const FeatureTensor& features, const CrossField& field, double count,
                       const ScaleOptions& options = {}, const RunContext& context = {});

}  // namespace quadrille
