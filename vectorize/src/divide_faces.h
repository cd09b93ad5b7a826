#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "outline_sampling.h"
#include "quadrille/quad_mesh.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// An edge of the polygons that lies on a feature, which stays and is bent to it.
struct FeatureEdge {
  std::array<int, 2> ends;   ///< points
  Eigen::Vector2d midpoint;  ///< of the feature between them
};

/// Makes quads of polygons of 3 or 4 corners: cleans them up, divides each into one quad per
/// corner, bends the border to the outline if there is one and the feature edges to their
/// features, and improves the shapes. Every point belongs to a polygon. The halves of feature edges
/// carry kFeatureEdge. Without `clean` the polygons' connectivity stays as it is.
QuadMesh divide_faces(std::vector<Eigen::Vector2d> points,
                      const std::vector<std::vector<int>>& polygons,
                      const std::vector<FeatureEdge>& features, const RunContext& context,
                      const OutlineSamples* outline = nullptr, bool clean = true);

}  // namespace quadrille
