#pragma once

#include <array>
#include <vector>

namespace quadrille {

/// A division of a polygon with corners 0 to n-1 by diagonals.
struct PolygonDivision {
  struct Piece {
    std::array<int, 4> corner;
    int size;
  };
  std::vector<Piece> pieces;   ///< quads, and one triangle if n is odd; oriented as the polygon
  std::vector<int> pieces_at;  ///< for each corner
};

inline constexpr int kMostDivided = 10;  ///< corners of the largest polygon with a table

/// All divisions of a polygon with n corners, 4 <= n <= kMostDivided, into as many quads as
/// possible.
const std::vector<PolygonDivision>& polygon_divisions(int n);

}  // namespace quadrille
