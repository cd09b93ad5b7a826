#pragma once

#include <vector>

#include "vertex_guides.h"

namespace quadrille {

/// The vertices after the steps, each along its guide and at most 0.35 of its shortest edge long.
/// Where a quad's scaled Jacobian would fall below `least` and below what it was, the steps of its
/// corners are halved until it does not.
std::vector<Eigen::Vector2d> take_steps(const QuadMesh& mesh, const VertexGuides& guides,
                                        const std::vector<Eigen::Vector2f>& steps, double least);

}  // namespace quadrille
