#pragma once

#include "grid_solver.h"
#include "quadrille/feature_tensor.h"

namespace quadrille {

/// The paper's Eq. 1-3 and Alg. 1 as printed, for comparison; unit modulus. Three things had to be
/// settled: the gradient is the colour gradient; w = e^G takes G as the gradient's length over the
/// picture's largest, so that w lies in [1, e]; and the rounds are capped, because Alg. 1 can send
/// a singularity to and fro for ever.
ComplexGrid paper_field(const FeatureTensor& features, const RunContext& context);

}  // namespace quadrille
