#include "quadrille/planar_loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

Loop square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

TEST(PlanarLoops, AreaPerimeterAndWindingOfASquare) {
  const Loop loop = square(1, 2, 4);
  EXPECT_EQ(signed_area(loop), 16);
  EXPECT_EQ(signed_area(reversed(loop)), -16);
  EXPECT_EQ(perimeter(loop), 16);
  EXPECT_EQ(winding_number(loop, {2, 3}), 1);
  EXPECT_EQ(winding_number(reversed(loop), {2, 3}), -1);
  EXPECT_EQ(winding_number(loop, {0, 3}), 0);
}

TEST(PlanarLoops, WindingCountsTurns) {
  Loop twice;
  for (int i = 0; i < 20; ++i) {
    const double angle = i * 2 * std::numbers::pi / 10, r = 1 + 0.01 * i;
    twice.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  EXPECT_EQ(winding_number(twice, {0, 0}), 2);
  EXPECT_FALSE(conflicts({twice}).empty());
}

TEST(PlanarLoops, SimpleDisjointLoopsHaveNoConflicts) {
  EXPECT_TRUE(conflicts({square(0, 0, 8), reversed(square(1, 1, 2)), square(1.5, 1.5, 1)}).empty());
}

TEST(PlanarLoops, FindsEveryKindOfContact) {
  const Loop bowtie = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const auto crossing = conflicts({bowtie});
  ASSERT_EQ(crossing.size(), 1u);
  EXPECT_EQ(crossing[0][0], (LoopSide{0, 0}));
  EXPECT_EQ(crossing[0][1], (LoopSide{0, 2}));

  EXPECT_FALSE(conflicts({square(0, 0, 2), square(2, 2, 2)}).empty()) << "a common corner";
  EXPECT_FALSE(conflicts({square(0, 0, 2), square(2, 0.5, 1)}).empty()) << "a common piece of side";
  EXPECT_FALSE(conflicts({square(0, 0, 2), {{2, 1}, {3, 0}, {3, 2}}}).empty())
      << "a corner on a side";
  EXPECT_FALSE(conflicts({{{0, 0}, {4, 0}, {2, 0}, {2, 2}}}).empty()) << "a spike";
  EXPECT_TRUE(conflicts({{{0, 0}, {2, 0}, {4, 0}, {2, 2}}}).empty()) << "straight on is none";
  EXPECT_FALSE(conflicts({{{0, 0}, {1, 0}}}).empty()) << "two points make no polygon";
}

TEST(PlanarLoops, NestingIsThatOfAnArea) {
  const Loop outer = square(0, 0, 8), hole = reversed(square(1, 1, 4)), island = square(2, 2, 1);
  EXPECT_TRUE(is_nested({outer, hole, island}));
  EXPECT_TRUE(is_nested({square(10, 0, 2), outer}));
  EXPECT_FALSE(is_nested({outer, island})) << "covered twice";
  EXPECT_FALSE(is_nested({outer, reversed(square(10, 0, 2))})) << "a hole in nothing";
  EXPECT_FALSE(is_nested({reversed(outer)}));
}

}  // namespace
}  // namespace quadrille
