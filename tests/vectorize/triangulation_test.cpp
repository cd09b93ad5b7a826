#include "triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace quadrille {
namespace {

std::int64_t doubled_area(const Triangulation& t) {
  std::int64_t sum = 0;
  for (const auto& triangle : t.triangles()) {
    const auto& p = t.points();
    sum += orientation(p[triangle.vertex[0]], p[triangle.vertex[1]], p[triangle.vertex[2]]);
  }
  return sum;
}

/// Every triangle is positive, they tile the rectangle, and neighbours know each other.
void expect_valid(const Triangulation& t, std::int64_t w, std::int64_t h) {
  EXPECT_EQ(doubled_area(t), 2 * w * h);
  for (int i = 0; i < static_cast<int>(t.triangles().size()); ++i) {
    const auto& triangle = t.triangles()[i];
    const auto& p = t.points();
    EXPECT_GT(orientation(p[triangle.vertex[0]], p[triangle.vertex[1]], p[triangle.vertex[2]]), 0);
    for (int k = 0; k < 3; ++k) {
      if (triangle.neighbour[k] < 0) continue;
      const auto& other = t.triangles()[triangle.neighbour[k]];
      const auto back = std::find(other.neighbour.begin(), other.neighbour.end(), i);
      ASSERT_NE(back, other.neighbour.end());
      const auto m = back - other.neighbour.begin();
      EXPECT_EQ(other.fixed[m], triangle.fixed[k]);
      EXPECT_EQ(other.vertex[(m + 1) % 3], triangle.vertex[(k + 2) % 3]);
      EXPECT_EQ(other.vertex[(m + 2) % 3], triangle.vertex[(k + 1) % 3]);
    }
  }
}

bool has_fixed_edge(const Triangulation& t, int a, int b) {
  for (const auto& triangle : t.triangles()) {
    for (int k = 0; k < 3; ++k) {
      const int u = triangle.vertex[(k + 1) % 3], v = triangle.vertex[(k + 2) % 3];
      if (triangle.fixed[k] && ((u == a && v == b) || (u == b && v == a))) return true;
    }
  }
  return false;
}

TEST(Triangulation, TilesTheRectangleForRandomPointsIncludingBorderAndDuplicates) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    const std::int64_t w = 40 + random() % 1000, h = 40 + random() % 1000;
    Triangulation t(w, h);
    for (int i = 0; i < 200; ++i) {
      GridPoint p{static_cast<std::int64_t>(random() % (w + 1)),
                  static_cast<std::int64_t>(random() % (h + 1))};
      if (i % 7 == 0) p.x = 0;
      if (i % 11 == 0) p.y = h;
      const int v = t.insert(p);
      EXPECT_EQ(t.points()[v], p);
      EXPECT_EQ(t.insert(p), v);
    }
    expect_valid(t, w, h);
    // Euler: triangles = 2 V - 2 - (points on the border).
    const auto on_border = std::count_if(t.points().begin(), t.points().end(), [&](auto& p) {
      return p.x == 0 || p.y == 0 || p.x == w || p.y == h;
    });
    EXPECT_EQ(t.triangles().size(), 2 * t.points().size() - 2 - on_border);
  }
}

TEST(Triangulation, EmptyCirclesOnGeneralPoints) {
  std::mt19937 random(2);
  Triangulation t(1000, 1000);
  for (int i = 0; i < 60; ++i) {
    t.insert(
        {static_cast<std::int64_t>(random() % 1001), static_cast<std::int64_t>(random() % 1001)});
  }
  for (const auto& triangle : t.triangles()) {
    const auto &a = t.points()[triangle.vertex[0]], &b = t.points()[triangle.vertex[1]],
               &c = t.points()[triangle.vertex[2]];
    const double d = 2.0 * orientation(a, b, c);
    const auto norm = [&](const GridPoint& p) { return double(p.x) * p.x + double(p.y) * p.y; };
    const double ux = (norm(a) * (b.y - c.y) + norm(b) * (c.y - a.y) + norm(c) * (a.y - b.y)) / d;
    const double uy = (norm(a) * (c.x - b.x) + norm(b) * (a.x - c.x) + norm(c) * (b.x - a.x)) / d;
    const double r = std::hypot(a.x - ux, a.y - uy);
    for (const GridPoint& p : t.points()) EXPECT_GE(std::hypot(p.x - ux, p.y - uy), r - 1e-6);
  }
}

TEST(Triangulation, RandomConstraintsHoldOrAreRefusedWhole) {
  std::mt19937 random(3);
  Triangulation t(500, 300);
  for (int i = 0; i < 150; ++i) {
    t.insert(
        {static_cast<std::int64_t>(random() % 501), static_cast<std::int64_t>(random() % 301)});
  }
  std::vector<std::array<int, 2>> kept;
  for (int i = 0; i < 300; ++i) {
    const int a = random() % t.points().size(), b = random() % t.points().size();
    if (t.insert_edge(a, b)) kept.push_back({a, b});
    expect_valid(t, 500, 300);
  }
  EXPECT_GT(kept.size(), 20u);
  for (const auto& [a, b] : kept) EXPECT_TRUE(has_fixed_edge(t, a, b));
}

TEST(Triangulation, CrossingConstraintIsRefused) {
  Triangulation t(100, 100);
  EXPECT_TRUE(t.insert_edge(0, 2));
  EXPECT_FALSE(t.insert_edge(1, 3));
  const int centre = t.insert({50, 50});
  EXPECT_FALSE(t.insert_edge(1, 3)) << "runs through a vertex";
  EXPECT_TRUE(t.insert_edge(1, centre));
  EXPECT_TRUE(has_fixed_edge(t, 0, centre)) << "a divided constraint stays one";
}

}  // namespace
}  // namespace quadrille
