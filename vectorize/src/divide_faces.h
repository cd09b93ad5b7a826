#pragma once

#include <Eigen/Core>
#include <vector>

#include "outline_sampling.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Divides every face, a strictly convex polygon given by its corners, into one quad per corner,
/// bends the border to the outline if there is one, and improves the shapes. Every point belongs to
/// a face. `width` and `height` are the picture's, in the points' unit.
QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& faces, double width, double height,
                      const OutlineSamples* outline = nullptr);

}  // namespace quadrille
