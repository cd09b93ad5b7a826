#include "pdf_agree.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"

namespace quadrille {
namespace {

using Node = CellTable::Node;

/// Two patches side by side, of one cell each or of one and of two along the edge between them.
struct Pair {
  PatchMesh patches = straight_patches(testing::lattice(2, 1, 20, 10));
  CellTable cells{2};

  Pair(std::uint8_t left, std::uint8_t right, int right_rows) {
    const Node node = {left, left, left};
    cells.add(0, {{1, 1}, {node, node, node, node}});
    std::vector<Node> nodes;
    for (int i = 0; i < 2 * (right_rows + 1); ++i) nodes.push_back({right, right, right});
    cells.add(1, {{1, right_rows}, nodes});
    agree_at_shared_sides(patches, paint_groups(patches.mesh, {1, 1}), 3, cells);
  }
};

TEST(AgreeAtSharedSides, NearColorsMeetInTheMiddle) {
  Pair pair(100, 103, 1);
  for (const int j : {0, 1}) {
    EXPECT_EQ(pair.cells.node(0, 0, j)[0], 100);
    EXPECT_EQ(pair.cells.node(0, 1, j), pair.cells.node(1, 0, j));
    EXPECT_NEAR(pair.cells.node(0, 1, j)[0], 101.5, 0.5);
    EXPECT_EQ(pair.cells.node(1, 1, j)[0], 103);
  }
}

TEST(AgreeAtSharedSides, MoreNodesOnOneSideMeetWhatLiesBetweenThoseOfTheOther) {
  Pair pair(100, 102, 2);
  for (const int j : {0, 1, 2}) EXPECT_EQ(pair.cells.node(1, 0, j)[0], 101) << j;
  EXPECT_EQ(pair.cells.node(1, 1, 1)[0], 102);
}

TEST(AgreeAtSharedSides, FarColorsStay) {
  Pair pair(100, 104, 2);
  for (const int j : {0, 1}) EXPECT_EQ(pair.cells.node(0, 1, j)[0], 100);
  for (const int j : {0, 1, 2}) EXPECT_EQ(pair.cells.node(1, 0, j)[0], 104);
}

}  // namespace
}  // namespace quadrille
