#pragma once

#include <Eigen/Core>
#include <vector>

namespace quadrille {

/// The numbers, divided into compact tiles of about equal size and at most `most` by the points
/// that they stand for: halves along the longer side, again and again. Ascending within a tile.
std::vector<std::vector<int>> divide_into_tiles(std::vector<int> numbers,
                                                const std::vector<Eigen::Vector2d>& points,
                                                int most);

}  // namespace quadrille
