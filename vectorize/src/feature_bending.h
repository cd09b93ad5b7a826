#pragma once

#include <vector>

#include "divide_faces.h"
#include "face_mesh.h"

namespace quadrille {

/// Moves the midpoint of every halved feature edge from its chord to the feature, as far as the
/// quads there keep sound corners, flags its halves as feature edges, and fixes their vertices.
void bend_features(QuadMesh& mesh, const std::vector<FeatureEdge>& features,
                   const std::vector<HalvedEdge>& halved, std::vector<VertexGuide>& guides);

}  // namespace quadrille
