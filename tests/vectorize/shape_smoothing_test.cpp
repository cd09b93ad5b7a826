#include "shape_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

double worst_jacobian(const QuadMesh& mesh) {
  double worst = 1;
  for (int q = 0; q < mesh.quad_count(); ++q) worst = std::min(worst, scaled_jacobian(mesh, q));
  return worst;
}

std::vector<VertexGuide> border_guides(const QuadMesh& mesh, double width, double height) {
  std::vector<VertexGuide> guides;
  for (const Vector2d& p : mesh.vertices) {
    const bool x_held = p.x() == 0 || p.x() == width, y_held = p.y() == 0 || p.y() == height;
    guides.push_back(x_held && y_held ? VertexGuide::at(p)
                     : x_held         ? VertexGuide::on_line(p, {0, 1})
                     : y_held         ? VertexGuide::on_line(p, {1, 0})
                                      : VertexGuide::free());
  }
  return guides;
}

/// Moves every vertex within its guide as far as no corner is turned over.
void shake(QuadMesh& mesh, const std::vector<VertexGuide>& guides, double reach,
           testing::Random& random) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (guides[v].kind == VertexGuide::Kind::fixed) continue;
    const Vector2d before = mesh.vertices[v];
    const Vector2d move(random.uniform(-reach, reach), random.uniform(-reach, reach));
    mesh.vertices[v] += guides[v].kind == VertexGuide::Kind::line
                            ? Vector2d(guides[v].direction.dot(move) * guides[v].direction)
                            : move;
    for (const int h : mesh.fan(v)) {
      if (scaled_jacobian(mesh, QuadMesh::quad_of(h)) < 0.02) mesh.vertices[v] = before;
    }
  }
}

TEST(SmoothShape, RaisesTheSmallestSineOfShakenLatticesAndKeepsThemValid) {
  testing::Random random(3);
  for (int i = 0; i < 60; ++i) {
    const int columns = random.integer(2, 12), rows = random.integer(2, 12);
    const double width = columns * random.uniform(1, 3), height = rows;
    QuadMesh mesh = testing::lattice(columns, rows, width, height);
    const std::vector<VertexGuide> guides = border_guides(mesh, width, height);
    shake(mesh, guides, 0.8, random);
    const double before = worst_jacobian(mesh);
    const std::vector<Vector2d> shaken = mesh.vertices;
    smooth_shape(mesh, guides);
    EXPECT_TRUE(validate(mesh, width, height).empty()) << i;
    EXPECT_GE(worst_jacobian(mesh), before);
    EXPECT_GT(worst_jacobian(mesh), std::min(before + 0.1, 0.4)) << i;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (guides[v].kind == VertexGuide::Kind::fixed) {
        EXPECT_EQ(mesh.vertices[v], shaken[v]);
      }
    }
  }
}

TEST(SmoothShape, MovesAVertexOfALineAlongIt) {
  QuadMesh mesh = testing::lattice(4, 4, 4, 4);
  std::vector<VertexGuide> guides = border_guides(mesh, 4, 4);
  const int v = 12;  // the middle one
  const Vector2d direction = Vector2d(2, 1).normalized();
  mesh.vertices[v] += 0.85 * direction;
  guides[v] = VertexGuide::on_line(mesh.vertices[v], direction);
  const double before = worst_jacobian(mesh);
  smooth_shape(mesh, guides);
  EXPECT_GT(worst_jacobian(mesh), before + 0.2);
  const Vector2d moved = mesh.vertices[v] - guides[v].point;
  EXPECT_NEAR(moved.x() * direction.y() - moved.y() * direction.x(), 0, 1e-12);
}

TEST(SmoothShape, LeavesWellShapedQuadsAlone) {
  // Graded, three times as long as wide.
  QuadMesh mesh = testing::lattice(6, 6, 6, 6);
  for (Vector2d& p : mesh.vertices) p = {p.x() * p.x() / 2, p.y() + 0.02 * p.x()};
  const std::vector<Vector2d> before = mesh.vertices;
  smooth_shape(mesh, std::vector<VertexGuide>(mesh.vertex_count()));
  EXPECT_EQ(mesh.vertices, before);
}

/// The star of the middle of a 2 x 2 lattice of cells with these sizes.
std::vector<StarWedge> lattice_star(double left, double right, double below, double above) {
  const Vector2d w(-left, 0), e(right, 0), s(0, -below), n(0, above);
  return {{e + n, n, e, e + n}, {w + n, w, n, w + n}, {w + s, s, w, w + s}, {e + s, e, s, e + s}};
}

TEST(VertexStar, DoesNotDependOnLengths) {
  const std::vector<StarWedge> wedges = lattice_star(1, 2, 6, 3);
  const VertexStar star(wedges);
  EXPECT_DOUBLE_EQ(star.smallest_sine({0, 0}), 1);
  const Vector2d p = star.improved({0, 0}, VertexGuide::free(), {0, 0}, 0);
  EXPECT_NEAR(p.norm(), 0, 1e-12);
}

TEST(VertexStar, LeadsOutOfAFold) {
  const std::vector<StarWedge> wedges = lattice_star(1, 1, 1, 1);
  const VertexStar star(wedges);
  for (const Vector2d& outside : {Vector2d(1.5, 0.2), {-0.3, -1.8}, {1.6, 1.4}}) {
    EXPECT_LT(star.smallest_sine(outside), 0);
    Vector2d p = outside;
    for (int i = 0; i < 8; ++i) p = star.improved(p, VertexGuide::free(), p, 0);
    EXPECT_GT(star.smallest_sine(p), 0.9) << outside.transpose();
  }
}

TEST(VertexStar, SpringsHoldBack) {
  const std::vector<StarWedge> wedges = lattice_star(1, 1, 1, 1);
  const VertexStar star(wedges);
  const Vector2d start(0.5, 0.3);
  double last = start.norm();
  for (const double hold : {100.0, 10.0, 1.0, 0.0}) {
    Vector2d p = start;
    for (int i = 0; i < 20; ++i) p = star.improved(p, VertexGuide::free(), start, hold);
    EXPECT_LT(p.norm(), last) << hold;
    last = p.norm();
  }
  EXPECT_LT(last, 0.01);
}

}  // namespace
}  // namespace quadrille
