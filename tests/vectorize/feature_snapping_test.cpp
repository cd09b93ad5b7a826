#include "quadrille/feature_snapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "quadrille/error.h"
#include "quadrille/quad_extraction.h"

namespace quadrille {
namespace {

/// 1 where `inside` holds, with the pixels on the edge between by 4 x 4 samples.
Raster two_phase(int w, int h, const std::function<bool(double, double)>& inside) {
  Raster picture(w, h, 3);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      int hits = 0;
      for (int k = 0; k < 16; ++k) hits += inside(x + (k % 4 + 0.5) / 4, y + (k / 4 + 0.5) / 4);
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = hits / 16.0f;
    }
  }
  return picture;
}

TEST(FeatureSnapping, EdgesOfTheMeshComeToLieOnAStraightEdge) {
  // Lattice lines at multiples of 10; the picture changes at 43.
  const Raster picture = two_phase(100, 80, [](double x, double) { return x > 43; });
  QuadMesh mesh = lattice_mesh(100, 80, 10, 8);
  std::vector<int> column;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertices[v].x() == 40) column.push_back(v);
  }
  snap_to_features(mesh, picture);
  for (const int v : column) EXPECT_NEAR(mesh.vertices[v].x(), 43, 1);
  EXPECT_TRUE(validate(mesh, 100, 80).empty());
}

TEST(FeatureSnapping, ACircleIsFollowedCloserThanBefore) {
  const auto radius = [](const Eigen::Vector2d& p) { return (p - Eigen::Vector2d(60, 60)).norm(); };
  const Raster picture = two_phase(120, 120, [&](double x, double y) {
    return radius({x, y}) < 37;
  });
  const QuadMesh before = lattice_mesh(120, 120, 15, 15);
  QuadMesh after = before;
  snap_to_features(after, picture);
  // The share of the circle that lies near an edge of the mesh.
  const auto followed = [&](const QuadMesh& mesh) {
    int hits = 0;
    for (int k = 0; k < 360; ++k) {
      const double a = k * std::acos(-1) / 180;
      const Eigen::Vector2d p(60 + 37 * std::cos(a), 60 + 37 * std::sin(a));
      double nearest = 1e9;
      for (int e = 0; e < mesh.edge_count(); ++e) {
        const int h = mesh.halfedge(e);
        const Eigen::Vector2d s = mesh.vertices[mesh.origin(h)], d = mesh.vertices[mesh.tip(h)] - s;
        const double t = std::clamp((p - s).dot(d) / d.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - s - t * d).norm());
      }
      hits += nearest < 1;
    }
    return hits;
  };
  EXPECT_GT(followed(after), followed(before) + 60);
  EXPECT_TRUE(validate(after, 120, 120).empty());
}

TEST(FeatureSnapping, NoisyPicturesKeepTheMeshValidAndItsCornersOpen) {
  const SnapOptions options;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    unsigned state = seed;
    Raster picture(70, 50, seed % 2 ? 3 : 4);
    for (float& v : picture.data) v = ((state = state * 1664525u + 1013904223u) >> 24) / 255.0f;
    QuadMesh mesh = lattice_mesh(70, 50, 12, 9);
    snap_to_features(mesh, picture, options);
    EXPECT_TRUE(validate(mesh, 70, 50).empty());
    for (int q = 0; q < mesh.quad_count(); ++q) {
      EXPECT_GE(scaled_jacobian(mesh, q), options.min_corner_sine);
    }
  }
}

TEST(FeatureSnapping, ConstantPictureAndNoRoundsMoveNothing) {
  Raster picture(60, 40, 3);
  QuadMesh mesh = lattice_mesh(60, 40, 6, 4);
  const auto before = mesh.vertices;
  snap_to_features(mesh, picture);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR((mesh.vertices[v] - before[v]).norm(), 0, 1e-9);
  }
  const Raster edge = two_phase(60, 40, [](double x, double) { return x > 33; });
  mesh.vertices = before;
  snap_to_features(mesh, edge, {.rounds = 0});
  EXPECT_EQ(mesh.vertices, before);
}

TEST(FeatureSnapping, SameForAnyThreadCount) {
  const Raster picture = two_phase(400, 300, [](double x, double y) { return x * y > 20000; });
  QuadMesh one = lattice_mesh(400, 300, 40, 30), many = one;
  RunContext single, three;
  single.threads = 1;
  three.threads = 3;
  snap_to_features(one, picture, {}, single);
  snap_to_features(many, picture, {}, three);
  EXPECT_EQ(one.vertices, many.vertices);
}

TEST(FeatureSnapping, RefusesOptionsOutOfRange) {
  QuadMesh mesh = lattice_mesh(10, 10, 2, 2);
  const Raster picture(10, 10, 3);
  EXPECT_THROW(snap_to_features(mesh, picture, {.rounds = -1}), Error);
  EXPECT_THROW(snap_to_features(mesh, picture, {.min_corner_sine = 1}), Error);
}

}  // namespace
}  // namespace quadrille
