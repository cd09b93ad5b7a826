#include "quadrille/patch_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::irregular_mesh;
using testing::lattice;
using testing::Random;
using testing::wild_lattice;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double least_jacobian(const BicubicHermite<Vector2d>& p, int steps) {
  double least = INFINITY;
  for (int j = 0; j <= steps; ++j) {
    for (int i = 0; i <= steps; ++i) {
      const double u = double(i) / steps, v = double(j) / steps;
      least = std::min(least, cross(p.derivative_u(u, v), p.derivative_v(u, v)));
    }
  }
  return least;
}

PatchMesh with_bessel_tangents(QuadMesh mesh) {
  PatchMesh patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  return patches;
}

/// A quarter of a ring between the radii 1 and 2, n quads around.
QuadMesh quarter_ring(int n) {
  QuadMesh mesh = lattice(n, 4, 1, 1);
  for (Vector2d& p : mesh.vertices) {
    const double angle = (1 - p.x()) * std::numbers::pi / 2;
    p = (2 - p.y()) * Vector2d(std::cos(angle), -std::sin(angle));
  }
  return mesh;
}

TEST(BesselTangents, EqualTheChordsOnALattice) {
  const PatchMesh patches = with_bessel_tangents(lattice(7, 5, 21, 10));
  const QuadMesh& mesh = patches.mesh;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
    for (const int at : {0, 1}) EXPECT_LT((tangent_along(patches, h, at) - chord).norm(), 1e-12);
  }
}

TEST(BesselTangents, AreTheDerivativeOfTheParabolaWithChordLengths) {
  QuadMesh mesh = lattice(2, 2, 4, 4);
  mesh.vertices[4] = {1, 1};  // neighbours 3 = (0, 2) and 5 = (4, 2)
  const PatchMesh patches = with_bessel_tangents(mesh);
  const Vector2d a = mesh.vertices[3], b = mesh.vertices[4], c = mesh.vertices[5];
  const double s = (b - a).norm(), t = (c - b).norm();
  // Newton's form of the parabola p(0) = a, p(s) = b, p(s + t) = c, differentiated at s.
  const Vector2d first = (b - a) / s, second = ((c - b) / t - first) / (s + t);
  const Vector2d derivative = first + s * second;
  const Vector2d start = first - s * second;
  for (const int h : mesh.fan(4)) {
    if (mesh.tip(h) == 5) {
      EXPECT_LT((tangent_along(patches, h, 0) - derivative * t).norm(), 1e-12);
    } else if (mesh.tip(h) == 3) {
      EXPECT_LT((tangent_along(patches, h, 0) + derivative * s).norm(), 1e-12);
      // The far end, on the border, is unpaired and takes the same parabola.
      EXPECT_LT((tangent_along(patches, h, 1) + start * s).norm(), 1e-12);
    }
  }
}

TEST(BesselTangents, OppositeEdgesRunStraightThroughValenceFour) {
  const PatchMesh patches = with_bessel_tangents(wild_lattice(6, 6, 60, 60, 1));
  const QuadMesh& mesh = patches.mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_border_vertex(v)) continue;
    for (int i : {0, 1}) {
      const Vector2d a = tangent_along(patches, mesh.fan(v)[i], 0);
      const Vector2d b = tangent_along(patches, mesh.fan(v)[i + 2], 0);
      EXPECT_NEAR(cross(a, b), 0, 1e-9 * a.norm() * b.norm());
      EXPECT_LT(a.dot(b), 0);
    }
  }
}

TEST(BesselTangents, BordersStayStraight) {
  for (const QuadMesh& mesh : {wild_lattice(6, 5, 60, 50, 2), irregular_mesh(5, 5, 60, 50, 3)}) {
    const PatchMesh patches = with_bessel_tangents(mesh);
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (!mesh.is_border(e)) continue;
      const int h = mesh.halfedge(e);
      const Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
      for (const Vector2d& t : patches.edge_tangents[e]) {
        EXPECT_EQ(cross(chord, t), 0);
        EXPECT_NEAR(t.dot(chord), chord.squaredNorm(), 1e-9);
      }
    }
  }
}

TEST(BesselTangents, CirclesAreApproachedWithThirdOrder) {
  const auto deviation = [](int n) {
    const PatchMesh patches = with_bessel_tangents(quarter_ring(n));
    double worst = 0;
    for (int q = 0; q < patches.patch_count(); ++q) {
      const auto p = patch_geometry(patches, q);
      for (const double t : {0.25, 0.5, 0.75}) {
        const double radius = (p.value[0].norm() + p.value[1].norm()) / 2;
        worst = std::max(worst, std::abs(p.at(t, 0).norm() - radius));
      }
    }
    return worst;
  };
  double coarse = deviation(4);
  EXPECT_LT(coarse, 0.02);
  for (const int n : {8, 16, 32}) {
    const double fine = deviation(n);
    EXPECT_LT(fine, coarse / 6) << n;
    coarse = fine;
  }
}

TEST(Certificate, HoldsForConvexStraightQuads) {
  Random random(4);
  int convex = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vector2d> p;
    for (int k = 0; k < 4; ++k) p.emplace_back(random.uniform(0, 10), random.uniform(0, 10));
    const PatchMesh patches = straight_patches(QuadMesh(p, {{0, 1, 2, 3}}));
    const bool expected = scaled_jacobian(patches.mesh, 0) > 0;
    convex += expected;
    EXPECT_EQ(certify_fold_free(patch_geometry(patches, 0)), expected);
  }
  EXPECT_GT(convex, 50);
}

TEST(Certificate, NeverLiesAndSeldomGivesUp) {
  Random random(5);
  int certified = 0, unfolded = 0;
  for (int i = 0; i < 1500; ++i) {
    PatchMesh patches = straight_patches(lattice(1, 1, 1, 1));
    const double bend = random.uniform(0, 1.5);
    for (auto& tangents : patches.edge_tangents) {
      for (Vector2d& t : tangents) {
        t += Vector2d(random.uniform(-bend, bend), random.uniform(-bend, bend));
      }
    }
    const auto p = patch_geometry(patches, 0);
    const double least = least_jacobian(p, 16);
    unfolded += least > 0.02;
    if (!certify_fold_free(p)) continue;
    ++certified;
    EXPECT_GT(least, 0);
  }
  EXPECT_GT(certified, 250);
  EXPECT_GT(certified, 0.97 * unfolded);
}

TEST(Certificate, NeedsThePatchToTurnTheRightWay) {
  const QuadMesh mirrored({{0, 0}, {0, 1}, {1, 1}, {1, 0}}, {{0, 1, 2, 3}});
  EXPECT_FALSE(certify_fold_free(patch_geometry(straight_patches(mirrored), 0)));
}

TEST(FoldGuard, LeavesGoodPatchesAlone) {
  PatchMesh patches = with_bessel_tangents(quarter_ring(8));
  const auto before = patches.edge_tangents;
  const FoldGuardReport report = guard_folds(patches);
  EXPECT_EQ(report.folded_before, 0);
  EXPECT_EQ(report.straightened, 0);
  EXPECT_EQ(patches.edge_tangents, before);
}

TEST(FoldGuard, UnfoldsEveryStrictlyConvexMesh) {
  int folded = 0;
  for (int seed = 0; seed < 30; ++seed) {
    PatchMesh patches = with_bessel_tangents(seed % 3 ? wild_lattice(8, 8, 80, 80, seed)
                                                      : irregular_mesh(5, 5, 80, 80, seed));
    Random random(seed);
    for (int e = 0; seed % 2 && e < patches.mesh.edge_count(); ++e) {
      if (patches.mesh.is_border(e)) continue;
      for (Vector2d& t : patches.edge_tangents[e]) {
        t += t.norm() * Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
      }
    }
    const FoldGuardReport report = guard_folds(patches);
    folded += report.folded_before;
    EXPECT_EQ(report.folded_after, 0);
    for (int q = 0; q < patches.patch_count(); ++q) {
      const auto p = patch_geometry(patches, q);
      EXPECT_TRUE(certify_fold_free(p));
      EXPECT_GT(least_jacobian(p, 10), 0);
    }
  }
  EXPECT_GT(folded, 100) << "the meshes are too tame to test anything";
}

TEST(FoldGuard, ReportsWhatItCannotRepair) {
  QuadMesh mesh = lattice(2, 2, 2, 2);
  mesh.vertices[4] = {1.9, 1.9};
  PatchMesh patches = straight_patches(std::move(mesh));
  const FoldGuardReport report = guard_folds(patches);
  EXPECT_EQ(report.folded_before, report.folded_after);
  EXPECT_GT(report.folded_after, 0);
}

}  // namespace
}  // namespace quadrille
