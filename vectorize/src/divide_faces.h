#pragma once

#include <Eigen/Core>
#include <vector>

#include "outline_sampling.h"
#include "quadrille/quad_mesh.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// Makes quads of polygons of 3 or 4 corners: cleans them up, divides each into one quad per
/// corner, bends the border to the outline if there is one, and improves the shapes. Every point
/// belongs to a polygon. Without `clean` their connectivity stays as it is.
QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& polygons, const RunContext& context,
                      const OutlineSamples* outline = nullptr, bool clean = true);

}  // namespace quadrille
