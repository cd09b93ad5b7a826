#pragma once

#include "angle_field.h"

namespace quadrille {

/// Searching for a pair takes memory and time by the square of the radius.
inline constexpr int kMaxCancellingRadius = 512;

struct CancelOptions {
  int radius = 64;       ///< CrossFieldOptions::cancelling_radius
  double allowance = 0;  ///< CrossFieldOptions::cancelling_allowance
};

/// The paper's Alg. 1 made to end: pairs of opposite singularities, cheapest first, are joined by
/// changing the period jumps along a least-cost path; then each one left may step where the angles
/// lean most. After every such change the angles around it are solved for anew with the jumps
/// fixed, and the change stays only if the energy fell (or rose within the allowance for every
/// singularity that went). What is far from a partner, or parted from it by a strong feature,
/// remains. Takes time by the number of singularities. Returns the pixels that may have changed.
FieldGrid<unsigned char> cancel_singularities(AngleField& field, const CancelOptions& options,
                                              const RunContext& context);

}  // namespace quadrille
