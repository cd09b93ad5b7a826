#include "edge_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "quadrille/patch_geometry.h"
#include "support/irregular_mesh.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using namespace testing;

/// Degrees by which the curve turns that comes in on one end and leaves on the other.
double turn(const QuadMesh& mesh, int a, int b) {
  const Vector2d p = mesh.vertices[vertex_at(mesh, a)];
  const Vector2d in = p - mesh.vertices[vertex_at(mesh, a ^ 1)];
  const Vector2d out = mesh.vertices[vertex_at(mesh, b ^ 1)] - p;
  return std::atan2(std::abs(in.x() * out.y() - in.y() * out.x()), in.dot(out)) * 180 / M_PI;
}

std::vector<int> ends_at(const QuadMesh& mesh, int v) {
  std::vector<int> ends;
  for (const int h : mesh.fan(v)) ends.push_back(edge_end(mesh, h, 0));
  return ends;
}

bool share_a_quad(const QuadMesh& mesh, int v, int a, int b) {
  for (const int h : mesh.fan(v)) {
    const int side = edge_end(mesh, h, 0), before = edge_end(mesh, QuadMesh::prev(h), 1);
    if ((a == side && b == before) || (b == side && a == before)) return true;
  }
  return false;
}

TEST(OppositeEnds, ContinueContoursAtAnyValence) {
  for (const EdgeFlag flag : {kTearEdge, kFeatureEdge}) {
    int smooth = 0, corners = 0;
    for (int seed = 0; seed < 20; ++seed) {
      QuadMesh mesh = irregular_mesh(7, 6, 100, 90, seed);
      Random random(seed);
      for (auto& flags : mesh.edge_flags) flags = random.uniform() < 0.25 ? flag : 0;
      const std::vector<int> opposite = opposite_ends(mesh);
      for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.is_border_vertex(v)) continue;
        std::vector<int> contour, others;
        for (const int end : ends_at(mesh, v)) {
          (mesh.edge_flags[end >> 1] ? contour : others).push_back(end);
        }
        for (const int end : contour) {
          const int o = opposite[end];
          if (o < 0) continue;
          EXPECT_EQ(opposite[o], end);
          EXPECT_TRUE(mesh.edge_flags[o >> 1]);
          EXPECT_LT(turn(mesh, end, o), 45);
        }
        for (const int end : others) {
          EXPECT_FALSE(opposite[end] >= 0 && mesh.edge_flags[opposite[end] >> 1]);
        }
        EXPECT_FALSE(contour.size() == 1 && opposite[contour[0]] >= 0);
        if (contour.size() != 2 || share_a_quad(mesh, v, contour[0], contour[1])) continue;
        const bool straight = turn(mesh, contour[0], contour[1]) < 45;
        EXPECT_EQ(opposite[contour[0]], straight ? contour[1] : -1);
        ++(straight ? smooth : corners);
      }
    }
    EXPECT_GT(smooth, 20);
    EXPECT_GT(corners, 20);
  }
}

TEST(OppositeEnds, OfThreeTearsPairTheStraightestTwo) {
  QuadMesh mesh = lattice(2, 2, 20, 20);
  mesh.vertices[4] = {10.5, 11};
  const auto end_toward = [&](int v) {
    const int e = edge_between(mesh, 4, v);
    mesh.edge_flags[e] = kTearEdge;
    return vertex_at(mesh, 2 * e) == 4 ? 2 * e : 2 * e + 1;
  };
  const int up = end_toward(1), right = end_toward(5), down = end_toward(7);
  const std::vector<int> opposite = opposite_ends(mesh);
  EXPECT_EQ(opposite[up], down);
  EXPECT_EQ(opposite[down], up);
  EXPECT_EQ(opposite[right], -1);
}

TEST(OppositeEnds, ATearGoesOnAsAFeature) {
  QuadMesh mesh = lattice(2, 2, 20, 20);
  const int above = edge_between(mesh, 4, 1), below = edge_between(mesh, 4, 7);
  mesh.edge_flags[above] = kTearEdge;
  mesh.edge_flags[below] = kFeatureEdge;
  const std::vector<int> opposite = opposite_ends(mesh);
  const int end = vertex_at(mesh, 2 * above) == 4 ? 2 * above : 2 * above + 1;
  EXPECT_EQ(opposite[end] >> 1, below);
}

TEST(OppositeEnds, CurvesThroughAChainStayOnItsCircle) {
  const Vector2d center(50.2, 48.9);
  const double radius = 30;
  for (const int columns : {3, 5, 9}) {
    DiscMesh disc = disc_mesh(columns, 2, 2, 100, 100, center, radius);
    tear(disc.mesh, disc.circle);
    PatchMesh patches = straight_patches(disc.mesh);
    set_bessel_tangents(patches);
    EXPECT_EQ(guard_folds(patches).folded_before, 0);
    double distance = 0, angle = 0;
    for (const int e : disc.circle) {
      const int h = disc.mesh.halfedge(e);
      const Vector2d p = disc.mesh.vertices[disc.mesh.origin(h)];
      const Vector2d q = disc.mesh.vertices[disc.mesh.tip(h)];
      angle = std::max(angle, 2 * std::asin((q - p).norm() / (2 * radius)));
      for (int i = 1; i < 16; ++i) {
        const auto basis = hermite_basis(i / 16.0);
        const Vector2d at = p * basis[0] + patches.edge_tangents[e][0] * basis[1] + q * basis[2] +
                            patches.edge_tangents[e][1] * basis[3];
        distance = std::max(distance, std::abs((at - center).norm() - radius));
      }
    }
    // For equal angles a the middle of such a curve is 3/128 a^4 radii off the circle.
    EXPECT_LT(distance, 0.03 * std::pow(angle, 4) * radius) << columns;
  }
}

}  // namespace
}  // namespace quadrille
