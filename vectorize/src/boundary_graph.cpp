#include "boundary_graph.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace quadrille {
namespace {

using Eigen::Vector2i;

/// Directions 0 to 3: right, down, left, up.
constexpr int kStepX[4] = {1, 0, -1, 0}, kStepY[4] = {0, 1, 0, -1};

class Tracer {
 public:
  explicit Tracer(const FieldGrid<int>& labels)
      : labels_(labels),
        open_(labels.width + 1, labels.height + 1, 0),
        node_(labels.width + 1, labels.height + 1, -1) {
    const int w = labels.width, h = labels.height;
    for (int y = 0; y <= h; ++y) {
      for (int x = 0; x <= w; ++x) {
        // A line runs right between the cells above and below, down between those beside it.
        if (x < w && y > 0 && y < h && labels(x, y - 1) != labels(x, y)) link(x, y, 0);
        if (y < h && x > 0 && x < w && labels(x - 1, y) != labels(x, y)) link(x, y, 1);
      }
    }
  }

  BoundaryGraph trace() {
    for (int y = 0; y < open_.height; ++y) {
      for (int x = 0; x < open_.width; ++x) {
        const int lines = degree(x, y);
        if (lines == 0 || lines == 2) continue;
        node_(x, y) = static_cast<int>(graph_.nodes.size());
        graph_.nodes.emplace_back(x, y);
      }
    }
    const std::size_t junctions = graph_.nodes.size();
    for (std::size_t n = 0; n < junctions; ++n) follow_all(graph_.nodes[n]);
    // What is left are loops without nodes.
    for (int y = 0; y < open_.height; ++y) {
      for (int x = 0; x < open_.width; ++x) {
        if (open_(x, y) == 0) continue;
        node_(x, y) = static_cast<int>(graph_.nodes.size());
        graph_.nodes.emplace_back(x, y);
        follow_all({x, y});
      }
    }
    return std::move(graph_);
  }

 private:
  const FieldGrid<int>& labels_;
  FieldGrid<unsigned char> open_;  // per corner the directions of lines not yet followed
  FieldGrid<int> node_;
  BoundaryGraph graph_;

  void link(int x, int y, int direction) {
    open_(x, y) |= 1 << direction;
    open_(x + kStepX[direction], y + kStepY[direction]) |= 1 << ((direction + 2) & 3);
  }
  int degree(int x, int y) const { return std::popcount(open_(x, y)); }

  void follow_all(const Vector2i& start) {
    while (open_(start.x(), start.y()) != 0) follow(start);
  }

  void follow(const Vector2i& start) {
    BoundaryGraph::Arc arc;
    arc.from = node_(start.x(), start.y());
    Vector2i at = start;
    arc.corners.push_back(at);
    do {
      const int direction = std::countr_zero(open_(at.x(), at.y()));
      open_(at.x(), at.y()) &= ~(1 << direction);
      at += Vector2i(kStepX[direction], kStepY[direction]);
      open_(at.x(), at.y()) &= ~(1 << ((direction + 2) & 3));
      arc.corners.push_back(at);
    } while (node_(at.x(), at.y()) < 0);
    arc.to = node_(at.x(), at.y());
    graph_.arcs.push_back(std::move(arc));
  }
};

/// Arcs and their ends at the nodes.
class Simplifier {
 public:
  explicit Simplifier(BoundaryGraph& graph) : graph_(graph), ends_(graph.nodes.size()) {
    for (int a = 0; a < static_cast<int>(graph.arcs.size()); ++a) {
      ends_[graph.arcs[a].from].push_back(a);
      ends_[graph.arcs[a].to].push_back(a);
    }
  }

  void leave_out_short(std::size_t least_corners, const std::vector<char>& is_anchored) {
    std::vector<int> open(graph_.arcs.size());
    std::iota(open.begin(), open.end(), 0);
    while (!open.empty()) {
      const int a = open.back();
      open.pop_back();
      const BoundaryGraph::Arc& arc = graph_.arcs[a];
      if (arc.corners.empty() || arc.corners.size() >= least_corners) continue;
      const auto is_loose = [&](int n) { return ends_[n].size() == 1 && !is_anchored[n]; };
      const bool is_lone_loop = arc.from == arc.to && ends_[arc.from].size() == 2;
      if (!is_lone_loop && !is_loose(arc.from) && !is_loose(arc.to)) continue;
      for (const int n : {arc.from, arc.to}) {
        std::erase(ends_[n], a);
        open.insert(open.end(), ends_[n].begin(), ends_[n].end());
      }
      graph_.arcs[a].corners.clear();
    }
  }

  void join_pairs() {
    for (std::size_t n = 0; n < ends_.size(); ++n) {
      if (ends_[n].size() == 2 && ends_[n][0] != ends_[n][1]) join(static_cast<int>(n));
    }
    std::erase_if(graph_.arcs, [](const BoundaryGraph::Arc& arc) { return arc.corners.empty(); });
  }

 private:
  BoundaryGraph& graph_;
  std::vector<std::vector<int>> ends_;  // arcs per node, a loop twice

  void join(int n) {
    const int a = ends_[n][0], b = ends_[n][1];
    BoundaryGraph::Arc &first = graph_.arcs[a], &second = graph_.arcs[b];
    const auto reverse = [](BoundaryGraph::Arc& arc) {
      std::reverse(arc.corners.begin(), arc.corners.end());
      std::swap(arc.from, arc.to);
    };
    if (first.to != n) reverse(first);
    if (second.from != n) reverse(second);
    first.corners.insert(first.corners.end(), second.corners.begin() + 1, second.corners.end());
    first.to = second.to;
    second.corners.clear();
    ends_[n].clear();
    std::replace(ends_[first.to].begin(), ends_[first.to].end(), b, a);
  }
};

}  // namespace

BoundaryGraph boundary_graph(const FieldGrid<int>& labels) { return Tracer(labels).trace(); }

void join_pairs(BoundaryGraph& graph) { Simplifier(graph).join_pairs(); }

void simplify(BoundaryGraph& graph, std::size_t least_corners,
              const std::vector<char>& is_anchored) {
  Simplifier simplifier(graph);
  simplifier.leave_out_short(least_corners, is_anchored);
  simplifier.join_pairs();
}

}  // namespace quadrille
