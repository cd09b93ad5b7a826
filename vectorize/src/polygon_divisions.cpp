#include "polygon_divisions.h"

namespace quadrille {
namespace {

using Pieces = std::vector<PolygonDivision::Piece>;

/// All divisions of the polygon first, first + 1, ..., last with at most `triangles` triangles; the
/// piece at the side from last to first is chosen first, then what remains beside it.
std::vector<Pieces> divide(int first, int last, int triangles) {
  const int sides = last - first + 1;
  if (sides == 2) return {{}};
  if (sides % 2 != triangles) return {};
  std::vector<Pieces> all;
  const auto combine = [&](const PolygonDivision::Piece& piece, const std::vector<Pieces>& parts) {
    for (Pieces division : parts) {
      division.push_back(piece);
      all.push_back(std::move(division));
    }
  };
  const auto both = [](const std::vector<Pieces>& left, const std::vector<Pieces>& right) {
    std::vector<Pieces> product;
    for (const Pieces& l : left) {
      for (const Pieces& r : right) {
        product.push_back(l);
        product.back().insert(product.back().end(), r.begin(), r.end());
      }
    }
    return product;
  };
  const auto parity = [](int from, int to) { return (to - from + 1) % 2; };
  for (int i = first + 1; i < last; ++i) {
    // Each part needs a triangle exactly when it has an odd number of sides.
    if (triangles == 1 && parity(first, i) + parity(i, last) == 0) {
      combine({{first, i, last, 0}, 3}, both(divide(first, i, 0), divide(i, last, 0)));
    }
    for (int j = i + 1; j < last; ++j) {
      if (parity(first, i) + parity(i, j) + parity(j, last) != triangles) continue;
      combine({{first, i, j, last}, 4},
              both(both(divide(first, i, parity(first, i)), divide(i, j, parity(i, j))),
                   divide(j, last, parity(j, last))));
    }
  }
  return all;
}

std::vector<PolygonDivision> with_counts(int n) {
  std::vector<PolygonDivision> divisions;
  for (Pieces& pieces : divide(0, n - 1, n % 2)) {
    PolygonDivision division{std::move(pieces), std::vector<int>(n, 0)};
    for (const auto& piece : division.pieces) {
      for (int k = 0; k < piece.size; ++k) ++division.pieces_at[piece.corner[k]];
    }
    divisions.push_back(std::move(division));
  }
  return divisions;
}

}  // namespace

const std::vector<PolygonDivision>& polygon_divisions(int n) {
  static const std::vector<std::vector<PolygonDivision>> tables = [] {
    std::vector<std::vector<PolygonDivision>> all(kMostDivided + 1);
    for (int k = 4; k <= kMostDivided; ++k) all[k] = with_counts(k);
    return all;
  }();
  return tables[n];
}

}  // namespace quadrille
