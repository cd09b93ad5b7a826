#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace quadrille {

/// How closely mesh edges follow a curve. Of two numbers the larger one counts: pixels, and a share
/// of the wished length of edges.
struct ArcTolerance {
  double most_bulge;                 ///< of the curve from an edge, as a share of its length
  double distance, coarse_distance;  ///< of the curve from the parabola through its ends and its
                                     ///< middle
  double shortest, coarse_shortest;  ///< arcs below this follow the curve well enough
};

/// True when an edge with a midpoint follows the curve `at(s)` between two arc lengths.
template <class Curve>
bool follows_arc(const Curve& at, double from, double to, double spacing,
                 const ArcTolerance& tolerance) {
  const double arc = to - from;
  if (arc < std::max(tolerance.shortest, tolerance.coarse_shortest * spacing)) return true;
  const Eigen::Vector2d a = at(from), b = at(to);
  const Eigen::Vector2d chord = b - a, bulge = at(0.5 * (from + to)) - 0.5 * (a + b);
  const double distance = std::max(tolerance.distance, tolerance.coarse_distance * spacing);
  if (bulge.norm() > std::max(tolerance.most_bulge * chord.norm(), 0.5 * distance)) return false;
  const int steps = std::clamp(static_cast<int>(arc), 4, 64);
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const Eigen::Vector2d parabola = a + t * chord + 4 * t * (1 - t) * bulge;
    if ((at(from + t * arc) - parabola).norm() > distance) return false;
  }
  return true;
}

/// Halves an arc until `is_good(from, to)` for all parts; visits the places between them,
/// ascending.
template <class Test, class Visit>
void halve_arc(double from, double to, const Test& is_good, const Visit& visit) {
  if (is_good(from, to)) return;
  const double middle = 0.5 * (from + to);
  halve_arc(from, middle, is_good, visit);
  visit(middle);
  halve_arc(middle, to, is_good, visit);
}

/// How many edges an arc takes where `spacing(t0, t1)` is their wished length on a part of it,
/// between two shares of its length; at least 1.
template <class PartSpacing>
int edge_count(double arc, const PartSpacing& spacing) {
  constexpr int kSteps = 16;
  double edges = 0;
  for (int k = 0; k < kSteps; ++k) {
    edges += arc / kSteps / spacing(static_cast<double>(k) / kSteps, (k + 1.0) / kSteps);
  }
  return std::max(1, static_cast<int>(std::lround(std::min(edges, 1e6))));
}

}  // namespace quadrille
