#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace quadrille {

/// A closed polygon: its last point joins its first. The area that it bounds lies on the side that
/// makes its shoelace sum positive; a hole therefore runs the other way round.
using Loop = std::vector<Eigen::Vector2d>;

/// The shoelace sum, half of sum (x_k y_{k+1} - x_{k+1} y_k): negative for a hole.
double signed_area(const Loop& loop);

double perimeter(const Loop& loop);

/// How often the loop runs around p in the positive sense. Undefined for p on the loop.
int winding_number(const Loop& loop, const Eigen::Vector2d& p);

/// Side `index` of a loop runs from its point `index` to the next one.
struct LoopSide {
  int loop = 0;
  int index = 0;
  auto operator<=>(const LoopSide&) const = default;
};

/// The pairs of sides that have a point in common which is not the corner between neighbours: what
/// keeps the loops from being simple and disjoint. Ascending. Exact for coordinates that are
/// multiples of 2^-k below 2^(25 - k) for some k. Loops of less than three points conflict with
/// themselves.
std::vector<std::array<LoopSide, 2>> conflicts(const std::vector<Loop>& loops);

/// True when loops without conflicts are the border of an area: each positive one lies outside of
/// that area's other parts, each negative one inside of exactly one.
bool is_nested(const std::vector<Loop>& loops);

}  // namespace quadrille
