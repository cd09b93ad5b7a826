#include "boundary_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace quadrille {
namespace {

using Eigen::Vector2i;
using Arc = BoundaryGraph::Arc;

template <class LabelAt>
FieldGrid<int> labelled(int w, int h, const LabelAt& label_at) {
  FieldGrid<int> labels(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) labels(x, y) = label_at(x, y);
  }
  return labels;
}

/// Arcs lead from node to node, a side of a cell at a time.
void expect_arcs_are_lines(const BoundaryGraph& graph) {
  for (const Arc& arc : graph.arcs) {
    ASSERT_GE(arc.corners.size(), 2u);
    EXPECT_EQ(arc.corners.front(), graph.nodes[arc.from]);
    EXPECT_EQ(arc.corners.back(), graph.nodes[arc.to]);
    for (std::size_t i = 1; i < arc.corners.size(); ++i) {
      EXPECT_EQ((arc.corners[i] - arc.corners[i - 1]).cwiseAbs().sum(), 1);
    }
  }
}

/// A straight line of corners.
std::vector<Vector2i> line(const Vector2i& from, const Vector2i& to) {
  const Vector2i step = (to - from).cwiseMax(-1).cwiseMin(1);
  std::vector<Vector2i> corners{from};
  while (corners.back() != to) corners.push_back(corners.back() + step);
  return corners;
}

TEST(BoundaryGraph, ThreeAreasMeetAtAJunction) {
  const BoundaryGraph graph =
      boundary_graph(labelled(6, 4, [](int x, int y) { return x < 3 ? 0 : 1 + (y >= 2); }));
  expect_arcs_are_lines(graph);
  const std::vector<Vector2i> nodes{{3, 0}, {3, 2}, {6, 2}, {3, 4}};  // row by row
  EXPECT_EQ(graph.nodes, nodes);
  ASSERT_EQ(graph.arcs.size(), 3u);
  for (const Arc& arc : graph.arcs) {
    EXPECT_NE(arc.from == 1, arc.to == 1);
    EXPECT_EQ(arc.corners.size(), arc.from == 2 || arc.to == 2 ? 4u : 3u);
  }
}

TEST(BoundaryGraph, FourAreasMeetAtOneNode) {
  const BoundaryGraph graph =
      boundary_graph(labelled(4, 4, [](int x, int y) { return (x < 2) != (y < 2); }));
  expect_arcs_are_lines(graph);
  EXPECT_EQ(graph.nodes.size(), 5u);
  EXPECT_EQ(graph.arcs.size(), 4u);
}

TEST(BoundaryGraph, ADiscHasOneLoop) {
  const BoundaryGraph graph =
      boundary_graph(labelled(20, 20, [](int x, int y) { return std::hypot(x - 10, y - 9) < 6; }));
  expect_arcs_are_lines(graph);
  ASSERT_EQ(graph.arcs.size(), 1u);
  ASSERT_EQ(graph.nodes.size(), 1u);
  // A staircase around the disc is as long as that around its bounding box.
  EXPECT_EQ(graph.arcs[0].corners.size(), 4u * 11 + 1);
}

TEST(BoundaryGraph, OneAreaHasNoLines) {
  const BoundaryGraph graph = boundary_graph(FieldGrid<int>(5, 4, 7));
  EXPECT_TRUE(graph.nodes.empty());
  EXPECT_TRUE(graph.arcs.empty());
}

TEST(BoundaryGraph, HasEverySideBetweenDifferentCellsOnce) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const int w = 1 + random() % 12, h = 1 + random() % 12, count = 1 + random() % 4;
    const FieldGrid<int> labels =
        labelled(w, h, [&](int, int) { return static_cast<int>(random() % count); });
    std::size_t sides = 0, found = 0;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        sides += x + 1 < w && labels(x, y) != labels(x + 1, y);
        sides += y + 1 < h && labels(x, y) != labels(x, y + 1);
      }
    }
    const BoundaryGraph graph = boundary_graph(labels);
    expect_arcs_are_lines(graph);
    for (const Arc& arc : graph.arcs) found += arc.corners.size() - 1;
    EXPECT_EQ(found, sides);
  }
}

/// A line from side to side with a spur of some sides in its middle.
BoundaryGraph line_with_spur(int sides) {
  BoundaryGraph graph;
  graph.nodes = {{0, 4}, {5, 4}, {10, 4}, {5, 4 + sides}};
  graph.arcs = {{line({0, 4}, {5, 4}), 0, 1},
                {line({10, 4}, {5, 4}), 2, 1},
                {line({5, 4}, {5, 4 + sides}), 1, 3}};
  return graph;
}
const std::vector<char> kEndsAnchored{1, 0, 1, 0};

TEST(SimplifyBoundaryGraph, ShortSpursGoAndWhatTheyPartedIsJoined) {
  BoundaryGraph graph = line_with_spur(3);
  simplify(graph, 6, kEndsAnchored);
  ASSERT_EQ(graph.arcs.size(), 1u);
  expect_arcs_are_lines(graph);
  EXPECT_EQ(graph.arcs[0].corners.size(), 11u);
  EXPECT_EQ(graph.arcs[0].from + graph.arcs[0].to, 0 + 2);
}

TEST(SimplifyBoundaryGraph, LongAndAnchoredSpursStay) {
  BoundaryGraph longer = line_with_spur(8);
  simplify(longer, 6, kEndsAnchored);
  EXPECT_EQ(longer.arcs.size(), 3u);
  BoundaryGraph anchored = line_with_spur(3);
  simplify(anchored, 6, {1, 0, 1, 1});
  EXPECT_EQ(anchored.arcs.size(), 3u);
}

TEST(SimplifyBoundaryGraph, LoopsStayWhereTheyAreLongEnough) {
  const auto loops = [](std::size_t least) {
    BoundaryGraph graph;
    graph.nodes = {{0, 0}};
    graph.arcs = {{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 0}}, 0, 0}};
    simplify(graph, least, {0});
    return graph.arcs.size();
  };
  EXPECT_EQ(loops(7), 1u);
  EXPECT_EQ(loops(8), 0u);
}

}  // namespace
}  // namespace quadrille
