#pragma once

#include <vector>

#include "triangulation.h"

namespace quadrille {

/// Merges the triangles pairwise across edges that are not constraints into convex quads, as many
/// as a greedy matching finds that serves triangles with one possible partner first and the better
/// shape otherwise. Returns every face as its corner vertices, positively oriented: quads and the
/// triangles that stayed single. Each face is strictly convex.
std::vector<std::vector<int>> convex_faces(const Triangulation& triangulation);

}  // namespace quadrille
