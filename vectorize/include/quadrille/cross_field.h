#pragma once

#include <complex>
#include <vector>

#include "quadrille/feature_tensor.h"

namespace quadrille {

/// A cross per working pixel: the angle modulo pi/2 as the unit-modulus number z = e^{4 i theta}.
struct CrossField {
  FieldGrid<std::complex<float>> z;
  /// |z| before the last normalisation, in [0, 1]: low near singularities and conflicts.
  FieldGrid<float> confidence;

  /// Angle of one of the four directions, in (-pi/4, pi/4], radians, x right and y down.
  double angle(int x, int y) const { return 0.25 * std::arg(z(x, y)); }
};

struct CrossFieldOptions {
  /// lambda, the weight of alignment to features against smoothness (> 0).
  double alignment = 0.1;
  /// Rounds of renormalisation after the linear solve, and the weight mu of the pull toward unit
  /// length; they remove 10 to 60 % of the singularities.
  int renormalizing_rounds = 5;
  double renormalizing_weight = 0.05;
};

/// Minimises sum w_ij |z_i - z_j|^2 + lambda sum w_i |z_i - z0_i|^2 by multigrid-preconditioned
/// conjugate gradients, then alternates z <- z/|z| with solves pulled toward it. Borders of the
/// picture are features. Departs from the paper's Eq. 3, which relaxes angles and has no data term:
/// it freezes with thousands of singularities and drifts off the features.
CrossField cross_field(const FeatureTensor& features, const CrossFieldOptions& options = {},
                       const RunContext& context = {});

/// A point around which the cross field turns by a quarter: index +1/4 or -1/4, at the corner
/// between four working pixels.
struct Singularity {
  double x = 0, y = 0;    ///< working pixels
  int quarter_index = 0;  ///< index times 4, never 0
};

/// Indices by the period jumps of Eq. 2 summed around each 2 x 2 block (paper Eq. 4).
std::vector<Singularity> singularities(const CrossField& field);

/// Mean angle in degrees between the field and the feature direction, weighted by feature weight,
/// over pixels on feature lines; 0 when there are none.
double misalignment_degrees(const CrossField& field, const FeatureTensor& features);

}  // namespace quadrille
