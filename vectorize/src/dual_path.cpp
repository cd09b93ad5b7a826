#include "dual_path.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace quadrille {
namespace {

constexpr std::array<int, 4> kStepX = {1, 0, -1, 0}, kStepY = {0, 1, 0, -1};
constexpr int kUnvisited = std::numeric_limits<int>::max();
// Buckets per unit of cost.
constexpr float kResolution = 16;
// Paths dearer than this per plaquette of the radius are not worth a trial: on indifferent ground a
// step costs 1.
constexpr float kDearest = 1.25f;
// How much dearer a step is per unit of data weight beside it.
constexpr float kDataCost = 2;
// Of two ways through ground that leans the right way, the shorter.
constexpr float kStepCost = 0.01f;

std::size_t quantised(float cost) {
  return static_cast<std::size_t>(std::max(cost, 0.0f) * kResolution + 0.5f);
}

}  // namespace

Plaquette neighbour(const Plaquette& from, int direction) {
  return {from.x + kStepX[direction], from.y + kStepY[direction]};
}

JumpChange crossing(const Plaquette& from, int direction, int quarter) {
  switch (direction) {
    case 0:
      return {from.x + 1, from.y, true, quarter};
    case 1:
      return {from.x, from.y + 1, false, -quarter};
    case 2:
      return {from.x, from.y, true, -quarter};
    default:
      return {from.x, from.y, false, quarter};
  }
}

float crossing_cost(const AngleField& field, const JumpChange& c) {
  const int x = c.x + !c.down, y = c.y + c.down;
  const float difference = principal(field.turns(x, y) - field.turns(c.x, c.y));
  // The rise of the squared difference, (|d| - 1)^2 - d^2 = 1 - 2 |d| before any re-solve.
  return 1 - 2 * static_cast<float>(c.change) * difference +
         kDataCost * (field.mass(c.x, c.y) + field.mass(x, y)) + kStepCost;
}

DualPathFinder::DualPathFinder(const AngleField& field, const IndexGrid& indices, int radius)
    : field_(field),
      indices_(indices),
      radius_(radius),
      nodes_(static_cast<std::size_t>(2 * radius + 1) * (2 * radius + 1)),
      buckets_(quantised(kDearest * static_cast<float>(radius)) + 1) {}

DualPathFinder::Node& DualPathFinder::node(const Plaquette& at, const Plaquette& centre) {
  const std::size_t side = 2 * radius_ + 1;
  return nodes_[(at.y - centre.y + radius_) * side + (at.x - centre.x + radius_)];
}

DualPath DualPathFinder::trace(const Plaquette& from, const Plaquette& to) {
  DualPath path{from, to, node(to, from).cost / kResolution, {}};
  const int quarter = indices_(from.x, from.y) > 0 ? 1 : -1;
  for (Plaquette at = to; at != from;) {
    const int direction = node(at, from).came_by;
    at = neighbour(at, (direction + 2) % 4);
    path.jumps.push_back(crossing(at, direction, quarter));
  }
  return path;
}

std::optional<DualPath> DualPathFinder::nearest_opposite(const Plaquette& from) {
  std::fill(nodes_.begin(), nodes_.end(), Node{kUnvisited, 0});
  for (auto& bucket : buckets_) bucket.clear();
  const int quarter = indices_(from.x, from.y) > 0 ? 1 : -1;
  node(from, from).cost = 0;
  buckets_[0].push_back(from);
  for (std::size_t cost = 0; cost < buckets_.size(); ++cost) {
    // A step may cost nothing: the bucket can grow while it is read.
    for (std::size_t k = 0; k < buckets_[cost].size(); ++k) {
      const Plaquette at = buckets_[cost][k];
      if (node(at, from).cost != static_cast<int>(cost)) continue;
      if (indices_(at.x, at.y) * quarter < 0) return trace(from, at);
      for (int direction = 0; direction < 4; ++direction) {
        const Plaquette next = neighbour(at, direction);
        if (!contains(indices_, next) || std::abs(next.x - from.x) > radius_ ||
            std::abs(next.y - from.y) > radius_) {
          continue;
        }
        const float step = crossing_cost(field_, crossing(at, direction, quarter));
        const std::size_t total = cost + quantised(step);
        Node& reached = node(next, from);
        if (total >= buckets_.size() || static_cast<int>(total) >= reached.cost) continue;
        reached = {static_cast<int>(total), static_cast<signed char>(direction)};
        buckets_[total].push_back(next);
      }
    }
  }
  return std::nullopt;
}

}  // namespace quadrille
