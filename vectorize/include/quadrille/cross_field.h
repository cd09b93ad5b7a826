#pragma once

#include <complex>
#include <string>
#include <vector>

#include "quadrille/feature_tensor.h"

namespace quadrille {

/// A point around which the cross field turns by a quarter: index +1/4 or -1/4, at the corner
/// between four working pixels.
struct Singularity {
  double x = 0, y = 0;    ///< working pixels
  int quarter_index = 0;  ///< index times 4, never 0
};

/// The field after one phase of its making.
struct CrossFieldPhase {
  std::string name;  ///< "smooth", "renormalised", "cancelled"; or "paper"
  std::vector<Singularity> singularities;
  /// sum_ij (theta_j - theta_i - p_ij pi/2)^2 + sum_i m_i (theta_i - theta0_i - k_i pi/2)^2 over
  /// 4-neighbours and pixels, in squared radians: the paper's Eq. 3 with the period jumps p of
  /// Eq. 2 and a data term. theta0 is the feature direction and m 5 lambda times its weight; on the
  /// picture's border theta0 is 0 and m 10. The jumps p and k are the nearest whole numbers.
  double energy = 0;
  double misalignment_degrees = 0;
};

/// A cross per working pixel: the angle modulo pi/2 as the unit-modulus number z = e^{4 i theta}.
struct CrossField {
  FieldGrid<std::complex<float>> z;
  /// In the order of the computation; the last one is this field.
  std::vector<CrossFieldPhase> phases;

  /// Angle of one of the four directions, in (-pi/4, pi/4], radians, x right and y down.
  double angle(int x, int y) const { return 0.25 * std::arg(z(x, y)); }
};

enum class CrossFieldMethod {
  smooth,  ///< linear solve, renormalisation, cancelling of singularities
  /// The paper's Eq. 1-3 and Alg. 1 as printed, for comparison: no data term, so the field drifts
  /// off the features and keeps most of its singularities.
  paper,
};

/// Heavier alignment leaves nothing to smooth, and single precision no room.
inline constexpr double kMaxAlignment = 1000;

struct CrossFieldOptions {
  CrossFieldMethod method = CrossFieldMethod::smooth;
  /// lambda, the weight of alignment to features against smoothness, in (0, kMaxAlignment].
  double alignment = 0.2;
  /// Rounds of renormalisation after the linear solve, and the weight mu of the pull toward unit
  /// length; they remove 10 to 60 % of the singularities.
  int renormalizing_rounds = 5;
  double renormalizing_weight = 0.05;
  /// Pairs of singularities up to this many working pixels apart, across or down, are tried for
  /// cancelling; at most 512. 0 leaves out that phase.
  int cancelling_radius = 64;
  /// By how much the energy may rise for each singularity that goes, in squared radians (>= 0). At
  /// 0 it strictly falls; 1 is about the energy of a singularity with 20 pixels around it. On ten
  /// photographs 0 / 1 / 2 left 11.2 / 7.0 / 4.2 singularities at 6.5 / 6.6 / 6.6 degrees and the
  /// same error of the patches.
  double cancelling_allowance = 2;
};

/// Minimises sum w_ij |z_i - z_j|^2 + lambda sum w_i |z_i - z0_i|^2 by full multigrid, then
/// alternates z <- z/|z| with solves pulled toward it. Then moves and cancels pairs of opposite
/// singularities (the idea of the paper's Alg. 1) as the energy of CrossFieldPhase allows.
/// Borders of the picture are features; as the cross is held there, no singularity leaves through
/// them. Departs from the paper's Eq. 3, which relaxes angles and has no data term: it freezes with
/// thousands of singularities and drifts off the features.
/// Throws Error{invalid_argument} for options out of range, Error{cancelled}.
CrossField cross_field(const FeatureTensor& features, const CrossFieldOptions& options = {},
                       const RunContext& context = {});

/// Indices by the period jumps of Eq. 2 summed around each 2 x 2 block (paper Eq. 4).
std::vector<Singularity> singularities(const CrossField& field);

/// Mean angle in degrees between the field and the feature direction, weighted by feature weight,
/// over pixels on feature lines; 0 when there are none.
double misalignment_degrees(const CrossField& field, const FeatureTensor& features);

}  // namespace quadrille
