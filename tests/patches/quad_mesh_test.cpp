#include "quadrille/quad_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "quadrille/error.h"
#include "support/irregular_mesh.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::irregular_mesh;
using testing::lattice;

std::set<std::string> violations(const QuadMesh& mesh, double width, double height) {
  std::set<std::string> kinds;
  for (const MeshViolation& v : validate(mesh, width, height)) kinds.insert(v.what);
  return kinds;
}

/// A 3 x 3 lattice without its middle quad.
QuadMesh ring() {
  const QuadMesh whole = lattice(3, 3, 3, 3);
  std::vector<QuadMesh::Quad> quads = whole.quads();
  quads.erase(quads.begin() + 4);
  return QuadMesh(whole.vertices, quads);
}

TEST(QuadMesh, HalfedgesAgreeWithTheirTwins) {
  for (const QuadMesh& mesh : {lattice(4, 3, 8, 6), irregular_mesh(5, 4, 10, 8, 1), ring()}) {
    for (int h = 0; h < mesh.halfedge_count(); ++h) {
      EXPECT_EQ(mesh.next(mesh.prev(h)), h);
      EXPECT_EQ(mesh.tip(h), mesh.origin(mesh.next(h)));
      EXPECT_LE(mesh.halfedge(mesh.edge(h)), h);
      const int t = mesh.twin(h);
      EXPECT_EQ(mesh.is_border(mesh.edge(h)), t < 0);
      if (t < 0) continue;
      EXPECT_EQ(mesh.twin(t), h);
      EXPECT_EQ(mesh.edge(t), mesh.edge(h));
      EXPECT_EQ(mesh.origin(t), mesh.tip(h));
      EXPECT_EQ(mesh.tip(t), mesh.origin(h));
    }
  }
}

TEST(QuadMesh, EdgesAreNumberedByTheirFirstHalfedge) {
  const QuadMesh mesh = irregular_mesh(4, 4, 8, 8, 2);
  for (int e = 1; e < mesh.edge_count(); ++e) EXPECT_LT(mesh.halfedge(e - 1), mesh.halfedge(e));
  EXPECT_EQ(mesh.edge_flags.size(), static_cast<std::size_t>(mesh.edge_count()));
}

TEST(QuadMesh, FansRunOnceAroundEveryVertex) {
  for (const QuadMesh& mesh : {lattice(4, 3, 8, 6), irregular_mesh(5, 4, 10, 8, 3), ring()}) {
    int corners = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const auto fan = mesh.fan(v);
      corners += static_cast<int>(fan.size());
      for (std::size_t i = 0; i < fan.size(); ++i) {
        EXPECT_EQ(mesh.origin(fan[i]), v);
        EXPECT_EQ(mesh.fan_position(fan[i]), static_cast<int>(i));
        const int after = mesh.twin(mesh.prev(fan[i]));
        if (i + 1 < fan.size()) {
          EXPECT_EQ(after, fan[i + 1]);
        } else {
          EXPECT_EQ(after, mesh.is_border_vertex(v) ? -1 : fan[0]);
        }
      }
      if (mesh.is_border_vertex(v)) {
        EXPECT_LT(mesh.twin(fan[0]), 0);
      } else {
        EXPECT_EQ(fan[0], *std::min_element(fan.begin(), fan.end()));
      }
    }
    EXPECT_EQ(corners, mesh.halfedge_count());
  }
}

TEST(QuadMesh, ValencesOfALattice) {
  const QuadMesh mesh = lattice(3, 2, 3, 2);
  const int expected[12] = {2, 3, 3, 2, 3, 4, 4, 3, 2, 3, 3, 2};
  for (int v = 0; v < 12; ++v) EXPECT_EQ(mesh.valence(v), expected[v]) << v;
  EXPECT_EQ(mesh.edge_count(), 17);
}

TEST(QuadMesh, NeighboursAreListedOnceAndAscending) {
  const QuadMesh mesh = lattice(4, 3, 8, 6);
  EXPECT_THAT(quads_at(mesh, std::vector<int>{7, 6}), ::testing::ElementsAre(0, 1, 2, 4, 5, 6));
  EXPECT_THAT(corners_of(mesh, std::vector<int>{1, 0}), ::testing::ElementsAre(0, 1, 2, 5, 6, 7));
  EXPECT_TRUE(quads_at(mesh, {}).empty());
}

TEST(QuadMesh, RejectsWhatIsNoMesh) {
  const std::vector<Vector2d> p = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}, {2, 2}, {1, 2}};
  const auto rejected = [&](std::vector<QuadMesh::Quad> quads, int vertices) {
    try {
      QuadMesh({p.begin(), p.begin() + vertices}, std::move(quads));
    } catch (const Error& e) {
      return e.code() == ErrorCode::invalid_argument;
    }
    return false;
  };
  EXPECT_FALSE(rejected({{0, 1, 2, 3}}, 4));
  EXPECT_TRUE(rejected({{0, 1, 2, 4}}, 4)) << "index out of range";
  EXPECT_TRUE(rejected({{0, 1, -1, 3}}, 4)) << "negative index";
  EXPECT_TRUE(rejected({{0, 1, 2, 1}}, 3)) << "repeated vertex";
  EXPECT_TRUE(rejected({{0, 1, 2, 3}}, 5)) << "vertex without a quad";
  EXPECT_TRUE(rejected({{0, 1, 2, 3}, {1, 2, 5, 4}}, 6)) << "edge run twice the same way";
  EXPECT_TRUE(rejected({{0, 1, 2, 3}, {1, 4, 5, 2}, {2, 1, 6, 7}}, 8)) << "edge of three quads";
}

TEST(QuadMesh, RejectsTwoFansAtOneVertex) {
  const std::vector<Vector2d> p = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
  EXPECT_THROW(QuadMesh(p, {{0, 1, 2, 3}, {2, 4, 5, 6}}), Error);
}

TEST(Validate, AcceptsTilings) {
  EXPECT_TRUE(validate(lattice(1, 1, 1, 1), 1, 1).empty());
  EXPECT_TRUE(validate(lattice(67, 45, 481, 321), 481, 321).empty());
  for (int seed = 0; seed < 20; ++seed) {
    EXPECT_TRUE(validate(irregular_mesh(5, 4, 31.7, 20.3, seed), 31.7, 20.3).empty());
  }
}

TEST(Validate, FindsEachKindOfViolation) {
  QuadMesh mesh = lattice(3, 3, 3, 3);
  mesh.vertices[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(violations(mesh, 3, 3), ::testing::ElementsAre("not finite"));

  mesh = lattice(3, 3, 3, 3);
  mesh.vertices[5] = {2.2, 2.2};
  EXPECT_THAT(violations(mesh, 3, 3), ::testing::ElementsAre("corner"));

  mesh = lattice(3, 3, 3, 3);
  mesh.vertices[1].y() = 0.1;
  EXPECT_THAT(violations(mesh, 3, 3), ::testing::ElementsAre("area", "border"));

  mesh = lattice(3, 3, 3, 3);
  std::swap(mesh.vertices[1], mesh.vertices[2]);
  EXPECT_TRUE(violations(mesh, 3, 3).count("border"));

  mesh = lattice(3, 3, 3, 3);
  mesh.vertices[0] = {0, 1e-3};
  EXPECT_TRUE(violations(mesh, 3, 3).count("border"));

  EXPECT_THAT(violations(ring(), 3, 3), ::testing::ElementsAre("area", "border", "euler"));
  EXPECT_THAT(violations(lattice(3, 3, 3, 3), 3, 4), ::testing::ElementsAre("area", "border"));
}

TEST(Validate, FindsAStraightCorner) {
  QuadMesh mesh = lattice(2, 1, 2, 1);
  mesh.vertices[1] = {0.5, 0};
  EXPECT_TRUE(validate(mesh, 2, 1).empty());
  const QuadMesh folded({{0, 0}, {1, 0}, {2, 0}, {0, 1}}, {{0, 1, 2, 3}});
  EXPECT_TRUE(violations(folded, 2, 1).count("corner"));
}

TEST(CountIrregularVertices, CountsWhatIsNotLattice) {
  EXPECT_EQ(count_irregular_vertices(lattice(1, 1, 1, 1)), 0);
  EXPECT_EQ(count_irregular_vertices(lattice(7, 1, 7, 1)), 0);
  EXPECT_EQ(count_irregular_vertices(lattice(5, 4, 5, 4)), 0);
  // One square of two triangles: two centroids of valence 3, and the diagonal's two corners.
  const QuadMesh mesh = irregular_mesh(1, 1, 1, 1, 0);
  EXPECT_EQ(mesh.quad_count(), 6);
  int three = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    three += !mesh.is_border_vertex(v) && mesh.valence(v) == 3;
  }
  EXPECT_EQ(three, 2);
  EXPECT_EQ(count_irregular_vertices(mesh), 2);
}

TEST(ScaledJacobian, IsTheSmallestSine) {
  EXPECT_DOUBLE_EQ(scaled_jacobian(lattice(1, 1, 5, 2), 0), 1);
  const QuadMesh sheared({{0, 0}, {2, 0}, {3, 1}, {1, 1}}, {{0, 1, 2, 3}});
  EXPECT_NEAR(scaled_jacobian(sheared, 0), std::sqrt(0.5), 1e-15);
  const QuadMesh reflex({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, {{0, 1, 2, 3}});
  EXPECT_LT(scaled_jacobian(reflex, 0), 0);
  const QuadMesh collapsed({{0, 0}, {0, 0}, {1, 1}, {0, 1}}, {{0, 1, 2, 3}});
  EXPECT_EQ(scaled_jacobian(collapsed, 0), 0);
}

}  // namespace
}  // namespace quadrille
