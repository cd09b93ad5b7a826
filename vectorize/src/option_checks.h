#pragma once

#include "quadrille/cross_field.h"
#include "quadrille/feature_chains.h"
#include "quadrille/feature_snapping.h"
#include "quadrille/position_field.h"
#include "quadrille/scale_field.h"

namespace quadrille {

struct VectorizeOptions;

/// Each throws Error{invalid_argument} for options outside their ranges. The stages check their
/// own.
void check_options(const CrossFieldOptions& options);
void check_options(const ScaleOptions& options);
void check_options(const PositionOptions& options);
void check_options(const SnapOptions& options);
void check_options(const ChainOptions& options);

/// Checks all of them, with those of tears, fits and vertices and the density map, before the work
/// starts, also where a stage is left out. Throws Error{limit_exceeded} above kMaxQuads.
void check_options(const VectorizeOptions& options);

}  // namespace quadrille
