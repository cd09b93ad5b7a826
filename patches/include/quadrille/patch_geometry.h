#pragma once

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Gives every edge the tangents of the Bessel scheme with chord-length parameters (Farin,
/// Hansford, The Essentials of CAGD): at a vertex, an edge and its opposite edge get the derivative
/// of the parabola through the three points, scaled by each edge's chord length, so curves are G1.
/// "Opposite" pairs the edges of a valence-4 interior vertex across each other, the two border
/// edges of a border vertex of valence 3 or more when they deviate from a straight line by less
/// than 45 degrees and neither continues an exactly straight piece of the border, and of the other
/// edges inside the pairs that deviate least, below 45 degrees, but never two sides of one quad;
/// unpaired ends take the parabola's end derivative toward the other end of the edge. Contours go
/// first: at a vertex of any valence tear edges pair with tear edges only, or else feature edges
/// with feature edges, or else a tear with a feature, always the least deviation first and below 45
/// degrees. So a chain of tears runs on smoothly, and keeps its corners. Straight pieces of the
/// border stay straight.
void set_bessel_tangents(PatchMesh& patches);

/// True when the Bezier coefficients of the Jacobian det(P_u, P_v) are all positive, after at most
/// `depth` subdivisions of the parameter square into quarters: a proof that the patch does not
/// fold. Positive means above 1e-13 of the product of the largest derivatives, which rounding could
/// not add.
bool certify_fold_free(const BicubicHermite<Eigen::Vector2d>& geometry, int depth = 2);

struct FoldGuardReport {
  int folded_before = 0;  ///< patches not certified before
  int straightened = 0;   ///< edges that ended up as straight chords
  int folded_after = 0;   ///< patches not certified after; 0 when every quad is strictly convex
};

/// Shrinks the tangents of uncertified patches step by step toward the chords of their edges until
/// all patches are certified. A strictly convex quad with straight edges always is. The collinear
/// tangents of opposite edges part where only one of them is shrunk.
FoldGuardReport guard_folds(PatchMesh& patches);

}  // namespace quadrille
