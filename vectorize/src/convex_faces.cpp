#include "convex_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace quadrille {
namespace {

using Corners = std::array<int, 4>;

// A quad with a flatter corner than this serves worse than two triangles.
constexpr double kMinCornerSine = 0.2;

/// Sine of the corner angle at b between a and c.
double corner_sine(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const double ux = static_cast<double>(c.x - b.x), uy = static_cast<double>(c.y - b.y);
  const double vx = static_cast<double>(a.x - b.x), vy = static_cast<double>(a.y - b.y);
  return (ux * vy - uy * vx) / (std::hypot(ux, uy) * std::hypot(vx, vy));
}

struct Pair {
  int triangle, edge, other;
  double quality;  // smallest corner sine
};

/// The quad across edge k of triangle t, in order.
Corners merged_corners(const Triangulation& triangulation, int t, int k) {
  const auto& triangle = triangulation.triangles()[t];
  const auto& far = triangulation.triangles()[triangle.neighbour[k]];
  const int u = triangle.vertex[(k + 1) % 3], v = triangle.vertex[(k + 2) % 3];
  int tip = far.vertex[0];
  for (const int f : far.vertex) {
    if (f != u && f != v) tip = f;
  }
  return {triangle.vertex[k], u, tip, v};
}

double quality(const Triangulation& triangulation, const Corners& c) {
  const auto& p = triangulation.points();
  double smallest = 1;
  for (int k = 0; k < 4; ++k) {
    smallest = std::min(smallest, corner_sine(p[c[(k + 3) % 4]], p[c[k]], p[c[(k + 1) % 4]]));
  }
  return smallest;
}

std::vector<Pair> possible_pairs(const Triangulation& triangulation) {
  std::vector<Pair> pairs;
  const auto& triangles = triangulation.triangles();
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int other = triangles[t].neighbour[k];
      if (other < t || triangles[t].fixed[k]) continue;
      const double q = quality(triangulation, merged_corners(triangulation, t, k));
      if (q >= kMinCornerSine) pairs.push_back({t, k, other, q});
    }
  }
  return pairs;
}

/// Karp and Sipser's heuristic: a triangle with one possible partner left is matched first.
std::vector<int> match(const std::vector<Pair>& pairs, std::size_t triangle_count) {
  std::vector<std::vector<int>> pairs_of(triangle_count);
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    pairs_of[pairs[i].triangle].push_back(i);
    pairs_of[pairs[i].other].push_back(i);
  }
  std::vector<int> order(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pairs[a].quality > pairs[b].quality; });

  std::vector<int> chosen(triangle_count, -1);
  std::vector<int> degree(triangle_count);
  std::queue<int> lonely;
  for (std::size_t t = 0; t < triangle_count; ++t) {
    degree[t] = static_cast<int>(pairs_of[t].size());
    if (degree[t] == 1) lonely.push(static_cast<int>(t));
  }
  const auto is_free = [&](int i) {
    return chosen[pairs[i].triangle] < 0 && chosen[pairs[i].other] < 0;
  };
  const auto choose = [&](int i) {
    for (const int t : {pairs[i].triangle, pairs[i].other}) chosen[t] = i;
    for (const int t : {pairs[i].triangle, pairs[i].other}) {
      for (const int j : pairs_of[t]) {
        const int other = pairs[j].triangle == t ? pairs[j].other : pairs[j].triangle;
        if (chosen[other] < 0 && --degree[other] == 1) lonely.push(other);
      }
    }
  };
  const auto serve_lonely = [&] {
    while (!lonely.empty()) {
      const int t = lonely.front();
      lonely.pop();
      if (chosen[t] >= 0) continue;
      for (const int i : pairs_of[t]) {
        if (is_free(i)) {
          choose(i);
          break;
        }
      }
    }
  };
  serve_lonely();
  for (const int i : order) {
    if (!is_free(i)) continue;
    choose(i);
    serve_lonely();
  }
  return chosen;
}

}  // namespace

std::vector<std::vector<int>> convex_faces(const Triangulation& triangulation) {
  const auto& triangles = triangulation.triangles();
  const std::vector<Pair> pairs = possible_pairs(triangulation);
  const std::vector<int> chosen = match(pairs, triangles.size());
  std::vector<std::vector<int>> faces;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    if (chosen[t] < 0) {
      faces.emplace_back(triangles[t].vertex.begin(), triangles[t].vertex.end());
    } else if (pairs[chosen[t]].triangle == t) {
      const Corners c = merged_corners(triangulation, t, pairs[chosen[t]].edge);
      faces.emplace_back(c.begin(), c.end());
    }
  }
  return faces;
}

}  // namespace quadrille
