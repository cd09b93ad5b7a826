#include "pdf_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paint_groups.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

/// A lattice torn along some of its edges.
QuadMesh torn_lattice(int columns, int rows, std::uint32_t seed) {
  QuadMesh mesh = testing::lattice(columns, rows, columns, rows);
  testing::Random random(seed);
  for (auto& flags : mesh.edge_flags) {
    if (random.uniform() < 0.15) flags |= kTearEdge;
  }
  return mesh;
}

TEST(PaintGroups, PatchesBesideAStraightTearAreInDifferentGroups) {
  QuadMesh mesh = testing::lattice(6, 4, 6, 4);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool middle =
        mesh.vertices[mesh.origin(h)].x() == 3 && mesh.vertices[mesh.tip(h)].x() == 3;
    if (middle) mesh.edge_flags[e] |= kTearEdge;
  }
  const PaintGroups groups = paint_groups(mesh, std::vector<char>(mesh.quad_count(), 1));
  EXPECT_EQ(groups.count, 2);
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < 0 || !mesh.is_tear(mesh.edge(h))) continue;
    EXPECT_NE(groups.group[h / 4], groups.group[mesh.twin(h) / 4]);
  }
  EXPECT_FALSE(group_region(mesh, groups, 1).empty());
}

TEST(PaintGroups, ARegionEndsAtATearThoughThePatchBeyondLiesSmoothlyBesideTheGroup) {
  QuadMesh mesh = testing::lattice(2, 2, 2, 2);
  PaintGroups groups;
  groups.group = {1, 1, 1, 0};
  groups.count = 2;
  groups.open_border = true;
  int tear = -1;
  for (int h = 4; h < 8; ++h) {
    if (mesh.twin(h) >= 12) tear = h;
  }
  ASSERT_GE(tear, 0);
  mesh.edge_flags[mesh.edge(tear)] |= kTearEdge;
  const auto region = group_region(mesh, groups, 1);
  const auto has_tear = [&](const EdgeLoop& loop) {
    return std::find(loop.begin(), loop.end(), tear) != loop.end();
  };
  EXPECT_TRUE(std::any_of(region.begin(), region.end(), has_tear));
}

TEST(PaintGroups, ARegionLeavesOutPatchesThatTouchTheGroupAcrossTearsAtACornerAlone) {
  // Quads 0 1 2 and below them 3 4 5, torn between the first column and the second. Quad 4 lies
  // smoothly beside quad 5, but on the other side of the tears from quad 0.
  QuadMesh mesh = testing::lattice(3, 2, 3, 2);
  PaintGroups groups;
  groups.group = {1, 0, 0, 0, 0, 1};
  groups.count = 2;
  groups.open_border = true;
  int left_out = -1, kept = -1;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < 0) continue;
    const int quad = QuadMesh::quad_of(h), other = QuadMesh::quad_of(mesh.twin(h));
    if (quad % 3 == 0 && other % 3 == 1) mesh.edge_flags[mesh.edge(h)] |= kTearEdge;
    if (quad == 5 && other == 4) left_out = h;
    if (quad == 0 && other == 3) kept = h;
  }
  ASSERT_GE(left_out, 0);
  ASSERT_GE(kept, 0);
  const auto region = group_region(mesh, groups, 1);
  const auto bounded_by = [&](int h) {
    return std::any_of(region.begin(), region.end(), [&](const EdgeLoop& loop) {
      return std::find(loop.begin(), loop.end(), h) != loop.end();
    });
  };
  EXPECT_TRUE(bounded_by(left_out));
  EXPECT_FALSE(bounded_by(kept));
}

TEST(PaintGroups, RegionsNeverGoAroundPatchesThatCannotBePainted) {
  constexpr int kQuads = 48;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const QuadMesh mesh = torn_lattice(8, 6, seed);
    testing::Random random(seed);
    std::vector<char> painted(kQuads), paintable(kQuads);
    for (int q = 0; q < kQuads; ++q) {
      paintable[q] = random.uniform() < 0.8;
      painted[q] = paintable[q] && random.uniform() < 0.8;
    }
    PaintGroups groups = paint_groups(mesh, painted, paintable);
    for (const bool open : {true, false}) {
      groups.open_border = groups.open_unpainted = open;
      for (int g = 0; g < groups.count; ++g) {
        for (const EdgeLoop& loop : group_region(mesh, groups, g)) {
          for (const int h : loop) EXPECT_TRUE(paintable[QuadMesh::quad_of(h)]);
        }
      }
    }
  }
}

TEST(PaintGroups, BordersCloseAroundAnySetOfQuads) {
  const QuadMesh mesh = testing::lattice(7, 5, 7, 5);
  testing::Random random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<char> inside(mesh.quad_count());
    double area = 0;
    for (char& in : inside) area += in = random.uniform() < 0.5;
    double enclosed = 0;
    for (const EdgeLoop& loop : border_of(mesh, inside)) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        ASSERT_EQ(mesh.tip(loop[i]), mesh.origin(loop[(i + 1) % loop.size()]));
        const auto &a = mesh.vertices[mesh.origin(loop[i])], &b = mesh.vertices[mesh.tip(loop[i])];
        enclosed += 0.5 * (a.x() * b.y() - b.x() * a.y());
      }
    }
    EXPECT_DOUBLE_EQ(enclosed, area);
  }
}

TEST(PatchOrder, VisitsEveryCellOnceFromNeighbourToNeighbour) {
  const QuadMesh mesh = torn_lattice(9, 7, 1);
  CellTable table(mesh.quad_count());
  testing::Random random(2);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    PatchCells cells{{random.integer(1, 2), random.integer(1, 3)}, {}};
    cells.nodes.resize((cells.count.u + 1) * (cells.count.v + 1));
    table.add(q, cells);
  }
  const PaintGroups groups = paint_groups(mesh, std::vector<char>(mesh.quad_count(), 1));
  std::vector<int> seen(mesh.quad_count(), 0);
  for (int g = 0; g < groups.count; ++g) {
    const PatchVisit* before = nullptr;
    const std::vector<PatchVisit> visits = visit_patches(mesh, groups, g, table);
    for (const PatchVisit& visit : visits) {
      ++seen[visit.quad];
      const Divisions count = table.count(visit.quad);
      const auto cells = visit.cells(count);
      EXPECT_EQ(static_cast<int>(cells.size()), count.u * count.v);
      for (std::size_t k = 1; k < cells.size(); ++k) {
        EXPECT_EQ(std::abs(cells[k].i - cells[k - 1].i) + std::abs(cells[k].j - cells[k - 1].j), 1);
      }
      if (visit.entry >= 0) {
        ASSERT_TRUE(before);
        EXPECT_EQ(mesh.twin(4 * visit.quad + visit.entry), 4 * before->quad + before->exit);
      }
      before = &visit;
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace quadrille
