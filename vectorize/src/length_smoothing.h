#pragma once

#include "metric_field.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// Replaces the lengths by those near to them that need few dislocations. Lattice lines along a
/// unit direction a (normal b) that are l apart stay lines of one lattice only where the frame
/// field is free of curl: d(log l_a)/db = -d(theta)/da, for both axes. Lengths may change along
/// their own axis at no cost, which is how cells become thin beside a feature without a single
/// irregular vertex. Minimises sum |l - wish|^2 + reach^2 |that difference|^2 by conjugate
/// gradients, with the axes matched between neighbours (Eq. 8 of the paper averages without
/// matching; QuadriFlow's scale optimisation, Huang et al. 2018, section 4, has the same aim).
/// `reach` is in coarse pixels.
void smooth_lengths(CoarseMetric& metric, double reach, const RunContext& context);

}  // namespace quadrille
