#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "quadrille/quad_mesh.h"
#include "support/random_patches.h"

namespace quadrille::testing {

/// Strictly convex quads with vertices of valence 3, 4, 5 and more over [0, width] x [0, height]:
/// a triangulated lattice with moved vertices and random diagonals, every triangle cut into three
/// quads at its centroid and the midpoints of its sides.
inline QuadMesh irregular_mesh(int columns, int rows, double width, double height,
                               std::uint32_t seed) {
  using Eigen::Vector2d;
  Random random(seed);
  std::vector<Vector2d> vertices = lattice(columns, rows, width, height).vertices;
  for (Vector2d& p : vertices) {
    const double x = random.uniform(-0.2, 0.2) * width / columns;
    const double y = random.uniform(-0.2, 0.2) * height / rows;
    if (p.x() != 0 && p.x() != width) p.x() += x;
    if (p.y() != 0 && p.y() != height) p.y() += y;
  }

  std::vector<QuadMesh::Quad> quads;
  std::map<std::pair<int, int>, int> midpoints;
  const auto add = [&](const Vector2d& p) {
    vertices.push_back(p);
    return static_cast<int>(vertices.size()) - 1;
  };
  const auto midpoint = [&](int a, int b) {
    const auto [it, is_new] = midpoints.try_emplace(std::minmax(a, b), 0);
    if (is_new) it->second = add((vertices[a] + vertices[b]) / 2);
    return it->second;
  };
  const auto add_triangle = [&](const std::array<int, 3>& t) {
    const int center = add((vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3);
    for (int k = 0; k < 3; ++k) {
      quads.push_back(
          {t[k], midpoint(t[k], t[(k + 1) % 3]), center, midpoint(t[(k + 2) % 3], t[k])});
    }
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      if (random.integer(0, 1)) {
        add_triangle({a, b, c});
        add_triangle({a, c, d});
      } else {
        add_triangle({a, b, d});
        add_triangle({b, c, d});
      }
    }
  }
  return QuadMesh(std::move(vertices), std::move(quads));
}

/// A lattice with vertices moved as far as they go while all quads stay strictly convex.
inline QuadMesh wild_lattice(int columns, int rows, double width, double height,
                             std::uint32_t seed) {
  using Eigen::Vector2d;
  Random random(seed);
  QuadMesh mesh = lattice(columns, rows, width, height);
  const std::vector<Vector2d> home = mesh.vertices;
  for (Vector2d& p : mesh.vertices) {
    const double x = random.uniform(-0.6, 0.6) * width / columns;
    const double y = random.uniform(-0.6, 0.6) * height / rows;
    if (p.x() != 0 && p.x() != width) p.x() += x;
    if (p.y() != 0 && p.y() != height) p.y() += y;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (int q = 0; q < mesh.quad_count(); ++q) {
      if (scaled_jacobian(mesh, q) > 0.01) continue;
      for (const int v : mesh.quads()[q]) {
        mesh.vertices[v] = home[v] + 0.9 * (mesh.vertices[v] - home[v]);
      }
      changed = true;
    }
  }
  return mesh;
}

}  // namespace quadrille::testing
