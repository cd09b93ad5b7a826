#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "quadrille/vectorize.h"
#include "table.h"

namespace quadrille::bench {

/// A row of the paper's Table 1: `phases`, from each phase of the cross field in its order to its
/// singularities, misalignment (degrees) and energy; and `local`, from each kind of local angle
/// smoothing on the same input to such figures for a ladder of alignment weights. Empty for the
/// lattice.
nlohmann::ordered_json field_figures(const Quadrangulation& quads);

/// Singularities can be bought with misalignment, so local angle smoothing is compared at equal
/// misalignment: with the one alignment weight, of those on the ladder and between two of them, at
/// which its mean over the rows is closest to the finished field's. Adds the figures that every row
/// has there as further phases (interpolated, with `alignment`).
void match_local_smoothing(std::vector<TableRow>& rows);

}  // namespace quadrille::bench
