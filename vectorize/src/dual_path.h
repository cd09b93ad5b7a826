#pragma once

#include <optional>

#include "window_solve.h"

namespace quadrille {

/// The plaquette between the pixels (x, y) and (x + 1, y + 1), where a singularity sits.
struct Plaquette {
  int x = 0, y = 0;

  bool operator==(const Plaquette&) const = default;
};

/// Index times 4 of every plaquette.
using IndexGrid = FieldGrid<signed char>;

inline bool contains(const IndexGrid& indices, const Plaquette& at) {
  return at.x >= 0 && at.y >= 0 && at.x < indices.width && at.y < indices.height;
}

/// A way for a quarter of index from one plaquette to another.
struct DualPath {
  Plaquette from, to;
  double cost = 0;
  std::vector<JumpChange> jumps;  ///< of the edges that it crosses, that carry it along
};

/// The plaquette in direction 0..3 (right, down, left, up), which may lie outside the grid.
Plaquette neighbour(const Plaquette& from, int direction);
/// The change of jump that carries a quarter of index, +1 or -1, over that step.
JumpChange crossing(const Plaquette& from, int direction, int quarter);
/// What the step costs a quarter of index: less, the more the angles already lean that way (Alg. 1
/// picks the largest difference), more where the data term holds them.
float crossing_cost(const AngleField& field, const JumpChange& crossed);

/// Least-cost paths on the dual grid (Dijkstra's algorithm with buckets), at most `radius`
/// plaquettes to each side. Keeps its work space between searches.
class DualPathFinder {
 public:
  DualPathFinder(const AngleField& field, const IndexGrid& indices, int radius);

  /// From a plaquette with an index to the nearest of the opposite sign.
  std::optional<DualPath> nearest_opposite(const Plaquette& from);

 private:
  struct Node {
    int cost;
    signed char came_by;  // direction
  };

  const AngleField& field_;
  const IndexGrid& indices_;
  int radius_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Plaquette>> buckets_;

  Node& node(const Plaquette& at, const Plaquette& centre);
  DualPath trace(const Plaquette& from, const Plaquette& to);
};

}  // namespace quadrille
