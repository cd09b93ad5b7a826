#include "clip_shapes.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

const Eigen::AlignedBox2d kBox(Vector2d(0, 0), Vector2d(100, 50));

SceneShapes shapes_of(std::vector<Vector2d> points, SceneShapes::Cell cell) {
  SceneShapes shapes;
  shapes.cell = cell;
  for (std::size_t i = 0; i < points.size(); ++i) shapes.cell_points.push_back(static_cast<int>(i));
  shapes.points = std::move(points);
  shapes.end_cell();
  return shapes;
}

WindowShapes clip(const SceneShapes& shapes) { return clip_shapes(shapes, {1, 1}, {0, 0}, kBox); }

TEST(ClipSegment, GivesThePartWithinTheBox) {
  testing::Random random(3);
  for (int round = 0; round < 1000; ++round) {
    const Vector2d from(random.uniform(-200, 300), random.uniform(-200, 250));
    const Vector2d to(random.uniform(-200, 300), random.uniform(-200, 250));
    Vector2d a = from, b = to;
    const bool meets = clip_segment(kBox, a, b);
    int inside = 0;
    for (int i = 0; i <= 500; ++i) {
      const Vector2d p = from + i / 500.0 * (to - from);
      if (!kBox.contains(p)) continue;
      ++inside;
      ASSERT_TRUE(meets);
      const double t = (p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-30);
      EXPECT_GE(t, -1e-9);
      EXPECT_LE(t, 1 + 1e-9);
    }
    const bool is_long = meets && (b - a).norm() > 2 * (to - from).norm() / 500;
    EXPECT_TRUE(inside > 0 || !is_long);
  }
}

TEST(ClipShapes, APolylineInsideStaysWhole) {
  const auto clipped = clip(shapes_of({{1, 1}, {50, 20}, {99, 3}}, SceneShapes::Cell::line));
  ASSERT_EQ(clipped.lines.size(), 1u);
  EXPECT_EQ(clipped.lines[0].points.size(), 3u);
}

TEST(ClipShapes, APolylineThatLeavesAndReturnsIsTwo) {
  const auto clipped =
      clip(shapes_of({{10, 10}, {10, 90}, {60, 90}, {60, 10}}, SceneShapes::Cell::line));
  ASSERT_EQ(clipped.lines.size(), 2u);
  EXPECT_EQ(clipped.lines[0].points.back(), Vector2d(10, 50));
  EXPECT_EQ(clipped.lines[1].points.front(), Vector2d(60, 50));
}

TEST(ClipShapes, CoordinatesStayNearTheWindowAtAnyZoom) {
  const SceneShapes shapes = shapes_of({{0, 0}, {1000, 501}}, SceneShapes::Cell::line);
  const auto clipped = clip_shapes(shapes, {1e6, 1e6}, {-5e8, -2.505e8}, kBox);
  ASSERT_EQ(clipped.lines.size(), 1u);
  for (const Vector2d& p : clipped.lines[0].points) EXPECT_LE(kBox.exteriorDistance(p), 1e-6);
}

TEST(ClipShapes, SidesThatPolygonsShareAreDrawnOnce) {
  SceneShapes shapes;
  shapes.cell = SceneShapes::Cell::polygon;
  shapes.points = {{1, 1}, {2, 1}, {2, 2}, {1, 2}, {3, 1}, {3, 2}};
  shapes.cell_points = {0, 1, 2, 3};
  shapes.end_cell();
  shapes.cell_points.insert(shapes.cell_points.end(), {1, 4, 5, 2});
  shapes.end_cell();
  EXPECT_EQ(clip(shapes).lines.size(), 7u);
}

TEST(ClipShapes, PointsOutsideAreLeftOut) {
  SceneShapes shapes;
  shapes.points = {{-1, 5}, {5, 5}, {500, 5}};
  const auto clipped = clip(shapes);
  ASSERT_EQ(clipped.points.size(), 1u);
  EXPECT_EQ(clipped.points[0].first, 1);
}

}  // namespace
}  // namespace quadrille::viewer
