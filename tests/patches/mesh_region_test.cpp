#include "quadrille/mesh_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// The cells of a lattice of unit squares for which `keep(column, row)`.
template <class Keep>
QuadMesh cells(int columns, int rows, const Keep& keep) {
  std::vector<int> vertex_of((columns + 1) * (rows + 1), -1);
  std::vector<Vector2d> vertices;
  std::vector<QuadMesh::Quad> quads;
  const auto vertex = [&](int i, int j) {
    int& v = vertex_of[j * (columns + 1) + i];
    if (v < 0) {
      v = static_cast<int>(vertices.size());
      vertices.emplace_back(i, j);
    }
    return v;
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (!keep(i, j)) continue;
      quads.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return QuadMesh(std::move(vertices), std::move(quads));
}

QuadMesh ring() {
  return cells(5, 5, [](int i, int j) { return !(i == 2 && j == 2); });
}

bool reports(const std::vector<MeshViolation>& found, const std::string& what) {
  return std::any_of(found.begin(), found.end(), [&](const auto& v) { return v.what == what; });
}

TEST(MeshRegion, WholeRectangleIsOneComponent) {
  const QuadMesh mesh = cells(4, 3, [](int, int) { return true; });
  EXPECT_TRUE(validate_region(mesh, 4, 3).empty());
  const MeshRegionSize size = region_size(mesh);
  EXPECT_EQ(size.components, 1);
  EXPECT_EQ(size.holes, 0);
  EXPECT_EQ(size.area, 12);
  EXPECT_EQ(size.outline_length, 14);
}

TEST(MeshRegion, RingHasAHole) {
  const QuadMesh mesh = ring();
  EXPECT_EQ(mesh.vertex_count() - mesh.edge_count() + mesh.quad_count(), 0);
  EXPECT_TRUE(validate_region(mesh, 5, 5).empty());
  const MeshRegionSize size = region_size(mesh);
  EXPECT_EQ(size.components, 1);
  EXPECT_EQ(size.holes, 1);
  EXPECT_EQ(size.area, 24);
  EXPECT_EQ(size.outline_length, 24);
  for (const auto& loop : border_loops(mesh)) {
    for (const int v : loop) EXPECT_TRUE(mesh.is_border_vertex(v));
  }
}

TEST(MeshRegion, IslandInAHoleIsAComponent) {
  const QuadMesh mesh = cells(7, 7, [](int i, int j) {
    const int ring = std::min({i, j, 6 - i, 6 - j});
    return ring == 0 || ring >= 2;
  });
  EXPECT_TRUE(validate_region(mesh, 7, 7).empty());
  const MeshRegionSize size = region_size(mesh);
  EXPECT_EQ(size.components, 2);
  EXPECT_EQ(size.holes, 1);
}

TEST(MeshRegion, NamesWhatIsWrong) {
  QuadMesh mesh = ring();
  mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(reports(validate_region(mesh, 5, 5), "not finite"));

  EXPECT_TRUE(reports(validate_region(ring(), 5, 4.5), "outside"));

  mesh = ring();
  std::swap(mesh.vertices[0], mesh.vertices[1]);
  EXPECT_TRUE(reports(validate_region(mesh, 5, 5), "corner"));
}

TEST(MeshRegion, NoticesPartsThatOverlap) {
  const auto two_squares = [](double x) {
    return QuadMesh({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {x, 1}, {x + 2, 1}, {x + 2, 3}, {x, 3}},
                    {{0, 1, 2, 3}, {4, 5, 6, 7}});
  };
  EXPECT_TRUE(validate_region(two_squares(5), 8, 8).empty());
  EXPECT_TRUE(reports(validate_region(two_squares(3), 8, 8), "border"));
  EXPECT_TRUE(reports(validate_region(two_squares(4), 8, 8), "border")) << "they touch";
  EXPECT_TRUE(reports(validate_region(two_squares(1), 8, 8), "nesting"));
}

}  // namespace
}  // namespace quadrille
