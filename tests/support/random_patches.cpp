#include "support/random_patches.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace quadrille::testing {
namespace {

using Eigen::Vector2d;

/// Smallest Jacobian determinant over a grid of parameters.
double least_jacobian(const BicubicHermite<Vector2d>& p) {
  constexpr int kSteps = 12;
  double least = INFINITY;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      const Vector2d du = p.derivative_u(u, v), dv = p.derivative_v(u, v);
      least = std::min(least, du.x() * dv.y() - du.y() * dv.x());
    }
  }
  return least;
}

void unfold(PatchMesh& patches, double least_allowed) {
  const QuadMesh& mesh = patches.mesh;
  for (bool changed = true; changed;) {
    changed = false;
    for (int q = 0; q < mesh.quad_count(); ++q) {
      if (least_jacobian(patch_geometry(patches, q)) >= least_allowed) continue;
      for (int k = 0; k < 4; ++k) {
        const int e = mesh.edge(4 * q + k), h = mesh.halfedge(e);
        const Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
        for (Vector2d& t : patches.edge_tangents[e]) {
          const Vector2d bend = t - chord;
          changed |= bend.norm() > 1e-3 * chord.norm();
          t = bend.norm() > 1e-3 * chord.norm() ? Vector2d(chord + 0.8 * bend) : chord;
        }
      }
    }
  }
}

}  // namespace

QuadMesh lattice(int columns, int rows, double width, double height) {
  std::vector<Vector2d> vertices;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      vertices.emplace_back(i == columns ? width : width * i / columns,
                            j == rows ? height : height * j / rows);
    }
  }
  std::vector<QuadMesh::Quad> quads;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + columns + 1;
      quads.push_back({a, a + 1, b + 1, b});
    }
  }
  return QuadMesh(std::move(vertices), std::move(quads));
}

PatchMesh random_patches(int columns, int rows, double width, double height, std::uint32_t seed,
                         const RandomPatchOptions& options) {
  Random random(seed);
  const QuadMesh regular = lattice(columns, rows, width, height);
  std::vector<Vector2d> vertices = regular.vertices;
  for (Vector2d& p : vertices) {
    const double x = random.uniform(-1, 1) * options.jitter * width / columns;
    const double y = random.uniform(-1, 1) * options.jitter * height / rows;
    if (p.x() != 0 && p.x() != width) p.x() += x;
    if (p.y() != 0 && p.y() != height) p.y() += y;
  }
  std::vector<QuadMesh::Quad> quads = regular.quads();
  for (auto& q : quads) std::rotate(q.begin(), q.begin() + random.integer(0, 3), q.end());

  PatchMesh patches = straight_patches(QuadMesh(std::move(vertices), std::move(quads)));
  const QuadMesh& mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    for (Vector2d& t : patches.edge_tangents[e]) {
      const double reach = options.curvature * t.norm();
      const Vector2d bend(random.uniform(-reach, reach), random.uniform(-reach, reach));
      if (mesh.is_border(e)) {
        t *= random.uniform(0.7, 1.3);
      } else {
        t += bend;
      }
    }
  }
  unfold(patches, 0.05 * width * height / (columns * rows));
  return patches;
}

void set_random_colors(PatchMesh& patches, std::uint32_t seed, bool opaque) {
  Random random(seed);
  const auto draw = [&](double low, double high) {
    Color c;
    for (int k = 0; k < 4; ++k) c[k] = static_cast<float>(random.uniform(low, high));
    return c;
  };
  for (Wedge& w : patches.wedges) {
    w.value = draw(0.05, 0.95);
    w.dx = draw(-0.05, 0.05);
    w.dy = draw(-0.05, 0.05);
    w.twist = draw(-0.01, 0.01);
    if (opaque) w.value[3] = 1, w.dx[3] = w.dy[3] = w.twist[3] = 0;
  }
  patches.opaque = opaque;
}

void set_linear_colors(PatchMesh& patches, const Color& base, const Color& along_x,
                       const Color& along_y) {
  const QuadMesh& mesh = patches.mesh;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const Vector2d p = mesh.vertices[mesh.origin(h)];
    Wedge& w = patches.wedges[patches.wedge_of_corner[h]];
    w.value = base + along_x * static_cast<float>(p.x()) + along_y * static_cast<float>(p.y());
    w.dx = along_x;
    w.dy = along_y;
    w.twist = Color::Zero();
  }
  patches.opaque = base[3] == 1 && along_x[3] == 0 && along_y[3] == 0;
}

}  // namespace quadrille::testing
