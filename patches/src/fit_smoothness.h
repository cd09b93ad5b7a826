#pragma once

#include "quadrille/patch_mesh.h"
#include "wedge_rows.h"

namespace quadrille {

/// Adds equations whose squares sum to about length^4 times the integral of the squared second
/// derivatives of the colours, which is what a thin plate's bending costs, over the patches. Like
/// those of a smoothing spline (Wahba, Spline Models for Observational Data, section 2.4) they
/// matter where details are not much larger than `length`, and never to linear colours. Colours on
/// the two sides of a tear do not see each other. Patches so large that this would be lost in
/// rounding are left out.
void add_smoothness(const PatchMesh& patches, double length, WedgeRows& rows);

}  // namespace quadrille
