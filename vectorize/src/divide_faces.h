#pragma once

#include <Eigen/Core>
#include <vector>

#include "outline_sampling.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Makes quads of polygons of 3 or 4 corners: cleans them up, divides each into one quad per
/// corner, bends the border to the outline if there is one, and improves the shapes. Every point
/// belongs to a polygon.
QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& polygons,
                      const OutlineSamples* outline = nullptr);

}  // namespace quadrille
