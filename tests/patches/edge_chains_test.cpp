#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "quadrille/tears.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using namespace testing;

constexpr int kColumns = 6;

/// A square lattice; vertex(i, j) is that in column i of row j.
QuadMesh lattice() { return split_mesh(kColumns, kColumns, 60, 60, 30, 30).mesh; }
int vertex(int i, int j) { return j * (kColumns + 1) + i; }

/// Flags the edges along a path of vertices given by its corners.
void flag(QuadMesh& mesh, std::vector<std::array<int, 2>> path) {
  for (std::size_t k = 1; k < path.size(); ++k) {
    auto [i, j] = path[k - 1];
    while (std::array{i, j} != path[k]) {
      const int a = vertex(i, j);
      i += (path[k][0] > i) - (path[k][0] < i);
      j += (path[k][1] > j) - (path[k][1] < j);
      mesh.edge_flags[edge_between(mesh, a, vertex(i, j))] |= kFeatureEdge;
    }
  }
}

/// Consecutive edges share a vertex, and no edge is in two places.
void expect_lines(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains) {
  std::set<int> seen;
  const auto ends = [&](int e) {
    const int h = mesh.halfedge(e);
    return std::set{mesh.origin(h), mesh.tip(h)};
  };
  for (const std::vector<int>& chain : chains) {
    for (std::size_t k = 0; k < chain.size(); ++k) {
      EXPECT_TRUE(seen.insert(chain[k]).second);
      EXPECT_TRUE(mesh.edge_flags[chain[k]] & kFeatureEdge);
      if (k == 0) continue;
      std::set<int> both = ends(chain[k]);
      both.merge(ends(chain[k - 1]));
      EXPECT_EQ(both.size(), 3u);
    }
  }
}

std::multiset<std::size_t> lengths(const QuadMesh& mesh) {
  const std::vector<std::vector<int>> chains = feature_edge_chains(mesh);
  expect_lines(mesh, chains);
  std::multiset<std::size_t> found;
  for (const std::vector<int>& chain : chains) found.insert(chain.size());
  return found;
}

TEST(FeatureEdgeChains, NoneWithoutFeatureEdges) {
  EXPECT_TRUE(feature_edge_chains(lattice()).empty());
  EXPECT_TRUE(feature_edge_chains(QuadMesh()).empty());
}

TEST(FeatureEdgeChains, ACircleIsOneClosedChain) {
  DiscMesh disc = disc_mesh(4, 2, 2, 40, 40, {20, 20}, 12);
  for (const int e : disc.circle) disc.mesh.edge_flags[e] |= kFeatureEdge;
  EXPECT_EQ(lengths(disc.mesh), std::multiset<std::size_t>{disc.circle.size()});
  auto edges = feature_edge_chains(disc.mesh).at(0);
  std::sort(edges.begin(), edges.end());
  std::sort(disc.circle.begin(), disc.circle.end());
  EXPECT_EQ(edges, disc.circle);
}

TEST(FeatureEdgeChains, EndAtJunctions) {
  QuadMesh mesh = lattice();
  flag(mesh, {{0, 3}, {6, 3}});
  EXPECT_EQ(lengths(mesh), (std::multiset<std::size_t>{6}));
  flag(mesh, {{2, 3}, {2, 6}});
  EXPECT_EQ(lengths(mesh), (std::multiset<std::size_t>{2, 3, 4}));
}

TEST(FeatureEdgeChains, EndAtCorners) {
  QuadMesh mesh = lattice();
  flag(mesh, {{1, 1}, {4, 1}, {4, 5}, {1, 5}, {1, 1}});
  EXPECT_EQ(lengths(mesh), (std::multiset<std::size_t>{3, 3, 4, 4}));
}

TEST(FeatureEdgeChains, LeaveOutTheBorder) {
  QuadMesh mesh = lattice();
  flag(mesh, {{0, 0}, {6, 0}, {6, 6}});
  EXPECT_TRUE(feature_edge_chains(mesh).empty());
  flag(mesh, {{3, 0}, {3, 2}});
  EXPECT_EQ(lengths(mesh), (std::multiset<std::size_t>{2}));
}

}  // namespace
}  // namespace quadrille
