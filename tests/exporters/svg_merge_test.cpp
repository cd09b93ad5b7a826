#include "svg_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>

#include "quadrille/export.h"
#include "support/programs.h"
#include "support/random_patches.h"
#include "svg_bleed.h"
#include "svg_tiles.h"

namespace quadrille {
namespace {

constexpr double kWidth = 60, kHeight = 40;

/// A lattice of straight patches; torn in the middle where wished.
PatchMesh straight_lattice(int columns, int rows, bool is_torn = false) {
  QuadMesh mesh = testing::lattice(columns, rows, kWidth, kHeight);
  for (int e = 0; is_torn && e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool in_middle = mesh.vertices[mesh.origin(h)].x() == kWidth / 2 &&
                           mesh.vertices[mesh.tip(h)].x() == kWidth / 2;
    if (in_middle) mesh.edge_flags[e] |= kTearEdge;
  }
  return straight_patches(mesh);
}

/// Some patches whole, some in two, some in three parts, so that corners lie within sides.
std::vector<PatchCell> divided(int patches) {
  std::vector<PatchCell> cells;
  for (int q = 0; q < patches; ++q) {
    if (q % 3 == 0) {
      cells.push_back({q, {}});
      continue;
    }
    cells.push_back({q, {0, 0, 0.5, 1}});
    if (q % 3 == 1) {
      cells.push_back({q, {0.5, 0, 1, 1}});
    } else {
      cells.push_back({q, {0.5, 0, 1, 0.5}});
      cells.push_back({q, {0.5, 0.5, 1, 1}});
    }
  }
  return cells;
}

double area(const SvgOutline& outline) {
  double sum = 0;
  Eigen::Vector2d from = outline.start;
  for (const SvgOutline::Piece& piece : outline.pieces) {
    EXPECT_TRUE(piece.is_line);
    sum += 0.5 * (from.x() * piece.end.y() - from.y() * piece.end.x());
    from = piece.end;
  }
  return sum;
}

double area(const ParameterBox& box) { return (box.u1 - box.u0) * (box.v1 - box.v0); }

/// The merged cells of patches that were divided at a low price.
std::vector<MergedCells> merged(const VectorImage& image, double price, double merge_price) {
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  const SvgDetail detail{price, 4};
  std::vector<SvgCell> cells;
  std::vector<PatchCell> parts;
  for (const int q : layer.quads(PatchOpacity::opaque)) {
    for (SvgCell& cell : divide_into_cells(layer, q, CellPaint::color, detail)) {
      parts.push_back(cell.part);
      cells.push_back(std::move(cell));
    }
  }
  for (SvgCell& cell : cells) cell.cost *= merge_price / price;
  const CellMesh mesh(layer, parts);
  return merge_cells(mesh, std::move(cells), merge_price, detail.units_per_pixel);
}

TEST(SvgMerge, OutlinesCoverTheUnionOfTheCellsExactly) {
  constexpr int kColumns = 6, kRows = 4;
  const VectorImage image =
      testing::single_layer(straight_lattice(kColumns, kRows), kWidth, kHeight);
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  const std::vector<PatchCell> cells = divided(kColumns * kRows);
  const CellMesh mesh(layer, cells);
  testing::Random random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<char> inside(cells.size());
    CellGroup group;
    double expected = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      inside[c] = random.uniform() < 0.5;
      if (!inside[c]) continue;
      group.cells.push_back(c);
      expected += area(cells[c].box) * kWidth * kHeight / (kColumns * kRows);
    }
    group.holds = [&](int c) { return inside[c] != 0; };
    group.is_later = [](int) { return false; };
    double covered = 0;
    for (const SvgOutline& outline : group_outlines(mesh, group, 0)) covered += area(outline);
    EXPECT_NEAR(covered, expected, 1e-9);
    // What is painted earlier everywhere leaves no room for bleed.
    covered = 0;
    for (const SvgOutline& outline : group_outlines(mesh, group, 1)) covered += area(outline);
    EXPECT_NEAR(covered, expected, 1e-9);
  }
}

TEST(SvgMerge, AGroupBleedsUnderLaterCellsAndOverNoOther) {
  const VectorImage image = testing::single_layer(straight_lattice(3, 1), kWidth, kHeight);
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  const CellMesh mesh(layer, {{0, {}}, {1, {}}, {2, {}}});
  const CellGroup middle{{1}, [](int c) { return c == 1; }, [](int c) { return c == 2; }};
  const std::vector<SvgOutline> outlines = group_outlines(mesh, middle, 1);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_NEAR(area(outlines[0]), (kWidth / 3 + 1) * kHeight, 1e-9);
}

TEST(SvgMerge, BleedsMeetAtTearsOverLaterCellsOnly) {
  const VectorImage image = testing::single_layer(straight_lattice(2, 2, true), kWidth, kHeight);
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  // Across the corner is a cell thinner than the bleed, and another beyond it.
  const CellMesh mesh(
      layer, {{0, {}}, {1, {}}, {2, {}}, {3, {0, 0, 1.0 / 64, 1}}, {3, {1.0 / 64, 0, 1, 1}}});
  for (const bool last_is_later : {false, true}) {
    const CellGroup first{
        {0}, [](int c) { return c == 0; }, [&](int c) { return c < 4 || last_is_later; }};
    const std::vector<SvgOutline> outlines = group_outlines(mesh, first, 1);
    ASSERT_EQ(outlines.size(), 1u);
    const double w = kWidth / 2, h = kHeight / 2, corner = last_is_later ? 1 : 0;
    EXPECT_NEAR(area(outlines[0]), w * h + w + h + corner, 1e-9);
  }
}

TEST(SvgMerge, HolesThatLaterCellsFillAreLeftOut) {
  const VectorImage image = testing::single_layer(straight_lattice(3, 3), kWidth, kHeight);
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  std::vector<PatchCell> cells;
  for (int q = 0; q < 9; ++q) cells.push_back({q, {}});
  const CellMesh mesh(layer, cells);
  for (const bool is_later : {true, false}) {
    const CellGroup ring{
        {0, 1, 2, 3, 5, 6, 7, 8}, [](int c) { return c != 4; }, [&](int) { return is_later; }};
    EXPECT_EQ(group_outlines(mesh, ring, 1).size(), is_later ? 1u : 2u);
  }
}

TEST(SvgMerge, HolesOfMoreThan64CellsAreKept) {
  constexpr int kColumns = 15, kRows = 10;
  const VectorImage image =
      testing::single_layer(straight_lattice(kColumns, kRows), kWidth, kHeight);
  const SvgLayer layer(image.layers[0], 0.01, kWidth, kHeight);
  std::vector<PatchCell> cells;
  for (int q = 0; q < kColumns * kRows; ++q) cells.push_back({q, {}});
  const CellMesh mesh(layer, cells);
  for (const auto& [columns, rows] : {std::pair{8, 8}, {13, 5}}) {
    const auto is_hole = [columns = columns, rows = rows](int c) {
      const int x = c % kColumns, y = c / kColumns;
      return x > 0 && y > 0 && x <= columns && y <= rows;
    };
    CellGroup ring{{}, [&](int c) { return !is_hole(c); }, is_hole};
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (!is_hole(c)) ring.cells.push_back(c);
    }
    EXPECT_EQ(group_outlines(mesh, ring, 1).size(), columns * rows <= 64 ? 1u : 2u);
  }
}

TEST(SvgMerge, NothingMergesAcrossATear) {
  PatchMesh patches = straight_lattice(6, 4, true);
  testing::set_linear_colors(patches, Color(0.2f, 0.6f, 0.4f, 1));
  const std::vector<MergedCells> groups =
      merged(testing::single_layer(std::move(patches), kWidth, kHeight), 1, 1);
  EXPECT_EQ(groups.size(), 2u);
  for (const MergedCells& group : groups) {
    const auto in_first = [](int cell) { return cell < 12; };  // part by part, whole patches
    for (const int c : group.cells) EXPECT_EQ(in_first(c), in_first(group.cells.front()));
  }
}

TEST(SvgMerge, WhatMergesDependsOnThePriceOfAByte) {
  PatchMesh patches = testing::random_patches(6, 4, kWidth, kHeight, 3);
  testing::set_random_colors(patches, 5, true);
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  std::vector<std::size_t> counts;
  for (const double price : {1e-3, 10.0, 1e9}) counts.push_back(merged(image, 1, price).size());
  EXPECT_GT(counts[0], counts[1]);
  EXPECT_GT(counts[1], 1u);
  EXPECT_EQ(counts[2], 1u);
}

TEST(SvgMerge, ALinearRampOverManyPatchesIsOneGradient) {
  PatchMesh patches = testing::random_patches(8, 6, kWidth, kHeight, 3);
  testing::set_linear_colors(patches, Color(0.1f, 0.2f, 0.9f, 1), Color(0.01f, 0.008f, -0.01f, 0));
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  const auto path = test::scratch_dir() / "ramp.svg";
  write_svg(image, path, {.level = SvgLevel::compact});
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  int paths = 0;
  for (auto at = text.find("url(#"); at != std::string::npos; at = text.find("url(#", at + 1)) {
    ++paths;
  }
  EXPECT_EQ(paths, 1);
}

TEST(SvgTiles, HoldEveryNumberOnceAndAreCompact) {
  constexpr int kSide = 40, kMost = 100;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < kSide * kSide; ++i) points.emplace_back(i % kSide, i / kSide);
  std::vector<int> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<int> found;
  for (const std::vector<int>& tile : divide_into_tiles(numbers, points, kMost)) {
    EXPECT_LE(tile.size(), std::size_t{kMost});
    EXPECT_GE(tile.size(), std::size_t{kMost / 2});
    Eigen::AlignedBox2d box;
    for (const int i : tile) box.extend(points[i]);
    EXPECT_LE(box.sizes().maxCoeff(), 2 * std::sqrt(kMost));
    found.insert(found.end(), tile.begin(), tile.end());
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, numbers);
}

}  // namespace
}  // namespace quadrille
