#pragma once

#include "quadrille/cross_field.h"
#include "quadrille/feature_tensor.h"

namespace quadrille {

/// Edge lengths of the lattice per working pixel, in working pixels, along the cross's two axes:
/// the paper's alpha L and beta L.
struct ScaleField {
  FieldGrid<float> along_x;  ///< length along the axis at CrossField::angle
  FieldGrid<float> along_y;  ///< length along the axis at angle + pi/2
};

struct ScaleOptions {
  /// Lengths fall with this power of the colour change along their own axis; 0 gives equal lengths.
  double grading = 0.5;
  /// A change below this share of the picture's mean counts as flat; > 0.
  double flat_share = 0.1;
  /// Bounds of a length over the mean one, before smoothing; 0 < min_ratio <= 1 <= max_ratio.
  double min_ratio = 0.3;
  double max_ratio = 2;
  /// Bound on the ratio of a cell's two lengths, >= 1.
  double max_anisotropy = 3;
  /// How far, in mean edges, lattice lines stay together: more gives fewer irregular vertices and
  /// less grading; >= 0.
  double reach = 1;
  /// The wished density beside that of the picture, > 0, any unit; as large as the working picture,
  /// or empty.
  FieldGrid<float> density;
};

/// Lengths in mean edges of `edge` working pixels. Along each axis of the cross: the mean over a
/// window of a third of an edge of the colour change along that axis (of the structure tensor
/// |grad| n n^T, so that parallel features closer than an edge shorten the axis across them and not
/// the one along them: the paper's beta, Eq. 7), to the power of -grading; then smoothed along the
/// lattice's lines, axes matched, isotropic near singularities. Replaces the paper's Eq. 5 and 6,
/// whose exp(E^2/v^2) overflows and whose zero divides by zero. Throws Error{invalid_argument} for
/// options outside their ranges.
ScaleField relative_scale(const FeatureTensor& features, const CrossField& field, double edge,
                          const ScaleOptions& options = {}, const RunContext& context = {});

/// How the lengths are fitted to the sides of the picture where the cross is aligned with them.
struct SideFit {
  /// They divide the sides; otherwise the lattice gets dislocations near them.
  bool whole_cells = true;
  /// Where they divide the sides, what a stretched cell costs beside a wrong number of cells, both
  /// as logarithms; > 0. Less keeps closer to the number.
  double stretch_cost = 0.2;
  /// Cells are stretched by this factor horizontally and shrunk by it vertically; > 0.
  double stretch = 1;
};

/// Relative lengths to lengths such that sum 1 / (length_x length_y) is `count` > 0, or near it
/// where they divide the sides.
ScaleField scaled_to_count(const ScaleField& relative, const CrossField& field, double count,
                           const SideFit& fit = {});

}  // namespace quadrille
