#include "grid_decomposition.h"

#include <gtest/gtest.h>

#include <set>

#include "quadrille/error.h"
#include "support/irregular_mesh.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

std::vector<QuadGrid> grids_of(const QuadMesh& mesh) {
  return regular_grids(mesh, std::vector<unsigned char>(mesh.quad_count(), 1));
}

/// Every quad in exactly one grid; neighbours in a grid are neighbours in the mesh; no tear, and
/// only vertices of valence 4, inside a grid.
void expect_decomposition(const QuadMesh& mesh, const std::vector<QuadGrid>& grids) {
  std::vector<int> uses(mesh.quad_count(), 0);
  for (const QuadGrid& grid : grids) {
    ASSERT_EQ(static_cast<int>(grid.tops.size()), grid.columns * grid.rows);
    ASSERT_LE(std::max(grid.columns, grid.rows), QuadGrid::kMostPerSide);
    for (int j = 0; j < grid.rows; ++j) {
      for (int i = 0; i < grid.columns; ++i) {
        const int h = grid.top(i, j);
        ++uses[QuadMesh::quad_of(h)];
        if (i > 0) {
          EXPECT_EQ(right_of(mesh, grid.top(i - 1, j)), h);
          EXPECT_FALSE(mesh.is_tear(mesh.edge(QuadMesh::prev(h))));
        }
        if (j > 0) {
          EXPECT_EQ(below(mesh, grid.top(i, j - 1)), h);
          EXPECT_FALSE(mesh.is_tear(mesh.edge(h)));
        }
        if (i > 0 && j > 0) {
          EXPECT_FALSE(mesh.is_border_vertex(mesh.origin(h)));
          EXPECT_EQ(mesh.valence(mesh.origin(h)), 4);
        }
      }
    }
  }
  EXPECT_EQ(uses, std::vector<int>(mesh.quad_count(), 1));
}

/// The quads with their corners renumbered, so that their half-edges start anywhere.
QuadMesh turned(const QuadMesh& mesh, std::uint32_t seed) {
  testing::Random random(seed);
  std::vector<QuadMesh::Quad> quads = mesh.quads();
  for (auto& quad : quads)
    std::rotate(quad.begin(), quad.begin() + random.integer(0, 3), quad.end());
  return QuadMesh(mesh.vertices, quads);
}

TEST(GridDecomposition, ALatticeIsOneGrid) {
  for (const auto& [columns, rows] : {std::pair{7, 5}, {1, 1}, {9, 1}, {2, 12}}) {
    const QuadMesh mesh = turned(testing::lattice(columns, rows, 70, 50), 3);
    const std::vector<QuadGrid> grids = grids_of(mesh);
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_EQ(std::minmax(grids[0].columns, grids[0].rows), std::minmax(columns, rows));
    expect_decomposition(mesh, grids);
  }
}

TEST(GridDecomposition, ALatticeThatIsTooLongIsCutBetweenGrids) {
  constexpr int kColumns = QuadGrid::kMostPerSide + 8;
  const QuadMesh mesh = testing::lattice(kColumns, 3, 400, 30);
  const std::vector<QuadGrid> grids = grids_of(mesh);
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].tops.size(), 3u * QuadGrid::kMostPerSide);
  EXPECT_EQ(grids[1].tops.size(), 3u * 8);
  expect_decomposition(mesh, grids);
}

TEST(GridDecomposition, ATearThroughALatticeMakesTwoGrids) {
  testing::SplitMesh split = testing::split_mesh(8, 6, 80, 60, 40, 40);
  testing::tear(split.mesh, split.line);
  const std::vector<QuadGrid> grids = grids_of(split.mesh);
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].tops.size(), 24u);
  EXPECT_EQ(grids[1].tops.size(), 24u);
  expect_decomposition(split.mesh, grids);
}

TEST(GridDecomposition, ATearThatEndsInsideIsNeverInsideAGrid) {
  testing::SplitMesh split = testing::split_mesh(8, 6, 80, 60, 40, 40);
  testing::tear(split.mesh, std::span(split.line).first(3));
  expect_decomposition(split.mesh, grids_of(split.mesh));
}

TEST(GridDecomposition, IrregularVerticesLieOnTheBordersOfGrids) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const QuadMesh mesh = testing::irregular_mesh(6, 5, 60, 50, seed);
    expect_decomposition(mesh, grids_of(mesh));
  }
}

TEST(GridDecomposition, RingsOfADiscAreCutOpen) {
  const testing::DiscMesh disc = testing::disc_mesh(4, 3, 4, 100, 80, {50, 40}, 25);
  const std::vector<QuadGrid> grids = grids_of(disc.mesh);
  expect_decomposition(disc.mesh, grids);
  // The rings around the block of 4 x 4 have 16 quads around; none counts twice.
  EXPECT_EQ(grids[0].tops.size(), 16u * 7);
}

TEST(GridDecomposition, CanBeCancelled) {
  const QuadMesh mesh = testing::lattice(60, 60, 60, 60);
  const std::vector<unsigned char> kinds(mesh.quad_count(), 1);
  const auto cancel = [](double part) {
    if (part > 0) throw Error(ErrorCode::cancelled, "cancelled");
  };
  EXPECT_THROW(regular_grids(mesh, kinds, cancel), Error);
}

TEST(GridDecomposition, KindsAreKeptApart) {
  const QuadMesh mesh = testing::lattice(6, 4, 60, 40);
  std::vector<unsigned char> kinds(24, 1);
  for (int q = 0; q < 24; ++q) kinds[q] = q % 6 < 2 ? 0 : q % 6 < 4 ? 1 : 2;
  const std::vector<QuadGrid> grids = regular_grids(mesh, kinds);
  ASSERT_EQ(grids.size(), 2u);
  for (const QuadGrid& grid : grids) {
    std::set<int> seen;
    for (const int h : grid.tops) seen.insert(kinds[QuadMesh::quad_of(h)]);
    EXPECT_EQ(grid.tops.size(), 8u);
    EXPECT_EQ(seen.size(), 1u);
    EXPECT_FALSE(seen.contains(0));
  }
}

}  // namespace
}  // namespace quadrille
