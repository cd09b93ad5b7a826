#include "quadrille/patch_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::lattice;
using testing::Random;
using testing::random_patches;

constexpr double kU[4] = {0, 1, 1, 0}, kV[4] = {0, 0, 1, 1};

PatchMesh colored_patches(std::uint32_t seed) {
  PatchMesh patches = random_patches(5, 4, 50, 40, seed);
  testing::set_random_colors(patches, seed + 1, false);
  return patches;
}

/// The edge of the lattice between two of its vertices.
int edge_between(const QuadMesh& mesh, int a, int b) {
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.origin(h) == a && mesh.tip(h) == b) return mesh.edge(h);
    if (mesh.origin(h) == b && mesh.tip(h) == a) return mesh.edge(h);
  }
  return -1;
}

PatchMesh torn(QuadMesh mesh, const std::vector<std::array<int, 2>>& tears) {
  for (const auto& [a, b] : tears) mesh.edge_flags[edge_between(mesh, a, b)] |= kTearEdge;
  return straight_patches(std::move(mesh));
}

int wedge_count_at(const PatchMesh& patches, int v) {
  std::set<int> wedges;
  for (const int h : patches.mesh.fan(v)) wedges.insert(patches.wedge_of_corner[h]);
  return static_cast<int>(wedges.size());
}

TEST(HermiteBasis, DerivativesMatchDifferences) {
  for (double t = 0; t <= 1; t += 0.125) {
    const auto low = hermite_basis(t - 1e-6), high = hermite_basis(t + 1e-6);
    const auto derivative = hermite_basis_derivative(t);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(derivative[i], (high[i] - low[i]) / 2e-6, 1e-9);
  }
}

TEST(FergusonPatch, InterpolatesItsCorners) {
  const PatchMesh patches = colored_patches(1);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    for (int k = 0; k < 4; ++k) {
      const Vector2d vertex = patches.mesh.vertices[patches.mesh.quads()[q][k]];
      const Wedge& w = patches.wedges[patches.wedge_of_corner[4 * q + k]];
      const Vector2d pu = patch.position.derivative_u(kU[k], kV[k]);
      EXPECT_EQ(patch.position.at(kU[k], kV[k]), vertex);
      EXPECT_TRUE((patch.color.at(kU[k], kV[k]) == w.value).all());
      EXPECT_EQ(pu, patch.position.du[k]);
      const Color along = w.dx * float(pu.x()) + w.dy * float(pu.y());
      EXPECT_LT((patch.color.derivative_u(kU[k], kV[k]) - along).abs().maxCoeff(), 1e-6);
    }
  }
}

TEST(FergusonPatch, DerivativesMatchDifferences) {
  const PatchMesh patches = colored_patches(2);
  const double d = 1e-5;
  for (int q = 0; q < patches.patch_count(); ++q) {
    const auto p = patch_geometry(patches, q);
    for (const double u : {0.2, 0.7}) {
      for (const double v : {0.3, 0.9}) {
        const Vector2d du = (p.at(u + d, v) - p.at(u - d, v)) / (2 * d);
        const Vector2d dv = (p.at(u, v + d) - p.at(u, v - d)) / (2 * d);
        EXPECT_LT((p.derivative_u(u, v) - du).norm(), 1e-7);
        EXPECT_LT((p.derivative_v(u, v) - dv).norm(), 1e-7);
      }
    }
  }
}

TEST(FergusonPatch, EqualsItsBezierForm) {
  const PatchMesh patches = colored_patches(3);
  Random random(4);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch f = ferguson_patch(patches, q);
    const BezierPatch b = bezier_patch(patches, q);
    for (int i = 0; i < 20; ++i) {
      const double u = random.uniform(), v = random.uniform();
      EXPECT_LT((f.position.at(u, v) - b.position.at(u, v)).norm(), 1e-12);
      EXPECT_LT((f.color.at(u, v) - b.color.at(u, v)).abs().maxCoeff(), 2e-6);
    }
  }
}

TEST(BicubicBezier, HalvesAreTheSameSurface) {
  const PatchMesh patches = colored_patches(5);
  const auto whole = bezier_patch(patches, 7).position;
  const auto [left, right] = whole.split_u();
  const auto [top, bottom] = whole.split_v();
  for (const double s : {0.0, 0.3, 1.0}) {
    for (const double t : {0.0, 0.6, 1.0}) {
      EXPECT_LT((left.at(s, t) - whole.at(s / 2, t)).norm(), 1e-12);
      EXPECT_LT((right.at(s, t) - whole.at((1 + s) / 2, t)).norm(), 1e-12);
      EXPECT_LT((top.at(s, t) - whole.at(s, t / 2)).norm(), 1e-12);
      EXPECT_LT((bottom.at(s, t) - whole.at(s, (1 + t) / 2)).norm(), 1e-12);
    }
  }
}

TEST(PatchGeometry, StraightPatchesAreBilinear) {
  const PatchMesh patches = straight_patches(testing::irregular_mesh(4, 3, 40, 30, 6));
  for (int q = 0; q < patches.patch_count(); ++q) {
    const auto p = patch_geometry(patches, q);
    for (const double u : {0.1, 0.5, 0.8}) {
      for (const double v : {0.25, 0.75}) {
        const Vector2d expected = p.value[0] * (1 - u) * (1 - v) + p.value[1] * u * (1 - v) +
                                  p.value[2] * u * v + p.value[3] * (1 - u) * v;
        EXPECT_LT((p.at(u, v) - expected).norm(), 1e-12);
      }
    }
  }
}

TEST(PatchMesh, NeighboursMeetWithoutGapOrJump) {
  const PatchMesh patches = colored_patches(7);
  const QuadMesh& mesh = patches.mesh;
  const auto on_side = [](const auto& patch, int k, double t) {
    return patch.at(kU[k] + t * (kU[(k + 1) % 4] - kU[k]), kV[k] + t * (kV[(k + 1) % 4] - kV[k]));
  };
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < h) continue;
    const FergusonPatch a = ferguson_patch(patches, QuadMesh::quad_of(h));
    const FergusonPatch b = ferguson_patch(patches, QuadMesh::quad_of(mesh.twin(h)));
    const int j = QuadMesh::corner_of(h), k = QuadMesh::corner_of(mesh.twin(h));
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      EXPECT_LT((on_side(a.position, j, t) - on_side(b.position, k, 1 - t)).norm(), 1e-12);
      EXPECT_LT((on_side(a.color, j, t) - on_side(b.color, k, 1 - t)).abs().maxCoeff(), 2e-6);
    }
  }
}

TEST(PatchMesh, TwistsAgreeAroundTheVertexOfALattice) {
  PatchMesh patches = straight_patches(lattice(2, 2, 20, 20));
  for (const int h : patches.mesh.fan(4)) {
    patches.wedges[patches.wedge_of_corner[h]].twist = Color(1, 0, 0, 0);
  }
  std::set<float> twists;
  for (const int h : patches.mesh.fan(4)) {
    twists.insert(
        ferguson_patch(patches, QuadMesh::quad_of(h)).color.duv[QuadMesh::corner_of(h)][0]);
  }
  EXPECT_EQ(twists.size(), 1u);
  EXPECT_EQ(std::abs(*twists.begin()), 100.0f);
}

TEST(PatchMesh, LinearColoursAreExact) {
  PatchMesh patches = random_patches(6, 5, 60, 50, 8);
  const Color base(0.1f, 0.2f, 0.3f, 1), x(0.01f, -0.002f, 0, 0), y(0.003f, 0, 0.004f, 0);
  testing::set_linear_colors(patches, base, x, y);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    for (const double t : {0.1, 0.4, 0.8}) {
      const Vector2d p = patch.position.at(t, 1 - t / 2);
      const Color expected = base + x * float(p.x()) + y * float(p.y());
      EXPECT_LT((patch.color.at(t, 1 - t / 2) - expected).abs().maxCoeff(), 1e-6);
    }
  }
}

TEST(Wedges, OnePerVertexWithoutTears) {
  const PatchMesh patches = straight_patches(testing::irregular_mesh(4, 4, 40, 40, 9));
  EXPECT_EQ(patches.wedges.size(), patches.mesh.vertices.size());
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    EXPECT_EQ(patches.wedge_of_corner[h], patches.mesh.origin(h));
  }
}

// Vertices of the 2 x 2 lattice: 0 1 2 / 3 4 5 / 6 7 8.
TEST(Wedges, ATearAcrossTheMeshDividesEveryVertexOnIt) {
  const PatchMesh patches = torn(lattice(2, 2, 2, 2), {{1, 4}, {4, 7}});
  EXPECT_EQ(patches.wedges.size(), 12u);
  for (const int v : {1, 4, 7}) EXPECT_EQ(wedge_count_at(patches, v), 2);
  // The left and the right quads keep their sides together at the centre.
  const auto at_center = [&](int q, int corner) { return patches.wedge_of_corner[4 * q + corner]; };
  EXPECT_EQ(at_center(0, 2), at_center(2, 1));
  EXPECT_EQ(at_center(1, 3), at_center(3, 0));
  EXPECT_NE(at_center(0, 2), at_center(1, 3));
}

TEST(Wedges, MergeAgainAtTheEndOfATear) {
  const PatchMesh patches = torn(lattice(2, 2, 2, 2), {{1, 4}});
  EXPECT_EQ(patches.wedges.size(), 10u);
  EXPECT_EQ(wedge_count_at(patches, 1), 2);
  EXPECT_EQ(wedge_count_at(patches, 4), 1);
}

TEST(Wedges, FourTearsMakeFourWedges) {
  const PatchMesh patches = torn(lattice(2, 2, 2, 2), {{1, 4}, {4, 7}, {3, 4}, {4, 5}});
  EXPECT_EQ(wedge_count_at(patches, 4), 4);
  EXPECT_EQ(patches.wedges.size(), 16u);
}

TEST(Wedges, CornersBetweenTwoTearsStayTogetherWhereverTheFanStarts) {
  for (int turn = 0; turn < 4; ++turn) {
    const QuadMesh regular = lattice(2, 2, 2, 2);
    std::vector<QuadMesh::Quad> quads = regular.quads();
    std::rotate(quads.begin(), quads.begin() + turn, quads.end());
    const PatchMesh patches = torn(QuadMesh(regular.vertices, quads), {{1, 4}, {4, 5}});
    EXPECT_EQ(wedge_count_at(patches, 4), 2);
    std::multiset<int> wedges;
    for (const int h : patches.mesh.fan(4)) wedges.insert(patches.wedge_of_corner[h]);
    const std::size_t first = wedges.count(*wedges.begin());
    EXPECT_TRUE(first == 1 || first == 3);
  }
}

}  // namespace
}  // namespace quadrille
