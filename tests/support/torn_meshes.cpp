#include "support/torn_meshes.h"

#include <cmath>

namespace quadrille::testing {

using Eigen::Vector2d;

DiscMesh disc_mesh(int columns, int rings_inside, int rings_outside, double width, double height,
                   const Vector2d& center, double radius) {
  const int n = columns, around = 4 * n;
  // The i-th point of the boundary of the square [-1, 1]^2, from (1, -1) toward (1, 1).
  const auto on_square = [&](int i) -> Vector2d {
    const double t = 2.0 * (i % n) / n - 1;
    const Vector2d points[4] = {{1, t}, {-t, 1}, {-1, -t}, {t, -1}};
    return points[(i / n) % 4];
  };
  std::vector<Vector2d> vertices;
  std::vector<QuadMesh::Quad> quads;
  // The middle block.
  const double half = 0.45 * radius;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      vertices.push_back(center + half * Vector2d(2.0 * i / n - 1, 2.0 * j / n - 1));
    }
  }
  const auto middle = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      quads.push_back({middle(i, j), middle(i + 1, j), middle(i + 1, j + 1), middle(i, j + 1)});
    }
  }
  const int rings = rings_inside + rings_outside;
  const int first_ring_vertex = static_cast<int>(vertices.size());
  const auto ring_vertex = [&](int ring, int i) {
    i %= around;
    if (ring > 0) return first_ring_vertex + (ring - 1) * around + i;
    const Vector2d p = (on_square(i) + Vector2d(1, 1)) * n / 2;
    return middle(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const Vector2d s = on_square(i), circle = center + radius * s.normalized();
      const Vector2d inner = center + half * s;
      const Vector2d outer((s.x() + 1) * width / 2, (s.y() + 1) * height / 2);
      const double t = ring <= rings_inside ? double(ring) / rings_inside
                                            : double(ring - rings_inside) / rings_outside;
      vertices.push_back(ring <= rings_inside ? Vector2d(inner + t * (circle - inner))
                                              : Vector2d(circle + t * (outer - circle)));
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      quads.push_back({ring_vertex(ring, i), ring_vertex(ring + 1, i), ring_vertex(ring + 1, i + 1),
                       ring_vertex(ring, i + 1)});
    }
  }
  DiscMesh disc{QuadMesh(std::move(vertices), std::move(quads)), {}};
  for (int i = 0; i < around; ++i) {
    disc.circle.push_back(
        edge_between(disc.mesh, ring_vertex(rings_inside, i), ring_vertex(rings_inside, i + 1)));
  }
  return disc;
}

SplitMesh split_mesh(int columns, int rows, double width, double height, double top,
                     double bottom) {
  const int middle = columns / 2;
  std::vector<Vector2d> vertices;
  std::vector<QuadMesh::Quad> quads;
  for (int j = 0; j <= rows; ++j) {
    const double y = height * j / rows, line = top + (bottom - top) * j / rows;
    for (int i = 0; i <= columns; ++i) {
      const double x = i <= middle ? line * i / middle
                                   : width - (width - line) * (columns - i) / (columns - middle);
      vertices.emplace_back(x, y);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      quads.push_back({a, a + 1, a + columns + 2, a + columns + 1});
    }
  }
  SplitMesh split{QuadMesh(std::move(vertices), std::move(quads)), {}};
  for (int j = 0; j < rows; ++j) {
    const int a = j * (columns + 1) + middle;
    split.line.push_back(edge_between(split.mesh, a, a + columns + 1));
  }
  return split;
}

int edge_between(const QuadMesh& mesh, int a, int b) {
  for (const int h : mesh.fan(a)) {
    if (mesh.tip(h) == b) return mesh.edge(h);
    if (mesh.origin(QuadMesh::prev(h)) == b) return mesh.edge(QuadMesh::prev(h));
  }
  return -1;
}

void tear(QuadMesh& mesh, std::span<const int> edges) {
  for (const int e : edges) mesh.edge_flags[e] |= kTearEdge;
}

Raster paint_box_filtered(int width, int height, int channels, int division,
                          const PremultipliedPainter& painter) {
  Raster picture(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Array4d sum = Eigen::Array4d::Zero();
      for (int j = 0; j < division; ++j) {
        for (int i = 0; i < division; ++i) {
          sum += painter(x + (i + 0.5) / division, y + (j + 0.5) / division);
        }
      }
      sum /= double(division) * division;
      if (channels == 4 && sum[3] > 0) sum.head<3>() /= sum[3];
      for (int k = 0; k < channels; ++k) picture.pixel(x, y)[k] = static_cast<float>(sum[k]);
    }
  }
  return picture;
}

}  // namespace quadrille::testing
