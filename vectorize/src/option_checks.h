#pragma once

#include "quadrille/cross_field.h"
#include "quadrille/feature_chains.h"
#include "quadrille/feature_snapping.h"
#include "quadrille/position_field.h"
#include "quadrille/scale_field.h"

namespace quadrille {

/// Each throws Error{invalid_argument} for options outside their ranges. The stages check their
/// own; quadrangulate() checks all of them first, with those of tears and fits, also where it
/// leaves a stage out.
void check_options(const CrossFieldOptions& options);
void check_options(const ScaleOptions& options);
void check_options(const PositionOptions& options);
void check_options(const SnapOptions& options);
void check_options(const ChainOptions& options);

}  // namespace quadrille
