#include "chain_tracing.h"

#include <algorithm>
#include <cmath>

#include "edge_profile.h"
#include "parallel.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Arc = BoundaryGraph::Arc;

constexpr double kSmoothing = 1.5;  // pixels on either side, of the staircase between the cells
constexpr double kSpacing = 0.75;   // pixels between points
constexpr double kFarthest = 1.25;  // an edge farther off belongs to another line
constexpr double kNodeReach = 2;    // pixels within which a junction blurs profiles
constexpr double kBlurred = 0.6;    // least sharpness anywhere along a run
constexpr double kGap = 4;          // pixels that a run may be weak for
constexpr double kSteepness = 0.3;  // least gradient per pixel and contrast
constexpr double kOblique = 0.4;    // sine of the angle between an arc and the edge
constexpr double kLeastGood = 0.5;  // share of a run that is neither weak nor oblique
constexpr int kArcCost = 64;        // in the pixels of parallel_rows

/// The middle of an arc's k-th side between two cells.
Vector2d middle(const Arc& arc, int k, double cell) {
  return (arc.corners[k] + arc.corners[k + 1]).cast<double>() * (0.5 * cell);
}
int side_count(const Arc& arc) { return static_cast<int>(arc.corners.size()) - 1; }

/// The direction of an arc about its k-th side.
Vector2d along(const Arc& arc, int k, double cell) {
  const int reach = static_cast<int>(std::lround(2 * kSmoothing / cell));
  const int a = std::max(0, k - reach), b = std::min(side_count(arc), k + 1 + reach);
  const Vector2d chord = (arc.corners[b] - arc.corners[a]).cast<double>();
  const double length = chord.norm();
  return length > 0 ? Vector2d(chord / length) : Vector2d(0, 0);
}

/// The direction in which the colours change most (Di Zenzo, A note on the gradient of a
/// multi-image, 1986).
Vector2d steepest(const PremultipliedColours& colours, const Vector2d& p) {
  constexpr double kArm = 0.75;
  using Colour = PremultipliedColours::Colour;
  const Colour dx = colours.at({p.x() + kArm, p.y()}) - colours.at({p.x() - kArm, p.y()});
  const Colour dy = colours.at({p.x(), p.y() + kArm}) - colours.at({p.x(), p.y() - kArm});
  const double angle = 0.5 * std::atan2(2 * dx.dot(dy), dx.squaredNorm() - dy.squaredNorm());
  return {std::cos(angle), std::sin(angle)};
}

/// False when no place of the line can have the least contrast.
bool may_be_strong(const Arc& arc, const FieldGrid<float>& gradient, double least) {
  return std::any_of(arc.corners.begin(), arc.corners.end(), [&](const Eigen::Vector2i& c) {
    const int x = std::clamp(c.x(), 0, gradient.width - 1);
    const int y = std::clamp(c.y(), 0, gradient.height - 1);
    return gradient(x, y) >= least;
  });
}

struct Run {
  int begin, last;  ///< sides of the arc
};

/// Runs with the least contrast and sharpness everywhere but for short gaps, and higher means.
std::vector<Run> runs_of(const Arc& arc, const PremultipliedColours& colours, double cell,
                         const ChainOptions& options) {
  const int n = side_count(arc);
  std::vector<EdgeProfile> profiles(n);
  std::vector<char> good(n);
  for (int k = 0; k < n; ++k) {
    const Vector2d p = middle(arc, k, cell);
    const Vector2d normal = steepest(colours, p);
    // Lines across a thin strip end at its edges, but are none.
    if (std::abs(along(arc, k, cell).dot(normal)) >= kOblique) continue;
    profiles[k] = edge_profile(colours, p, normal);
    good[k] = std::abs(profiles[k].offset) <= kFarthest &&
              profiles[k].contrast >= options.weak_contrast && profiles[k].sharpness >= kBlurred;
  }
  const int gap = static_cast<int>(kGap / cell);
  std::vector<Run> found;
  const auto add = [&](int begin, int last) {
    double contrast = 0, sharpness = 0, count = 0;
    for (int k = begin; k <= last; ++k) {
      if (!good[k]) continue;
      contrast += profiles[k].contrast, sharpness += profiles[k].sharpness, ++count;
    }
    if (contrast < options.contrast * count || sharpness < options.sharpness * count) return;
    // Profiles beside a junction show three colours.
    const Run run{begin <= gap ? 0 : begin, n - 1 - last <= gap ? n - 1 : last};
    if (count >= kLeastGood * (run.last - run.begin + 1)) found.push_back(run);
  };
  int begin = -1, last = -1;
  for (int k = 0; k < n; ++k) {
    if (!good[k]) continue;
    if (begin >= 0 && k - last > gap) {
      add(begin, last);
      begin = -1;
    }
    if (begin < 0) begin = k;
    last = k;
  }
  if (begin >= 0) add(begin, last);
  return found;
}

/// The line through the middles of the sides, smoothed and at even spacing.
std::vector<Vector2d> smooth_line(const Arc& arc, double cell) {
  const int n = side_count(arc);
  const int reach = static_cast<int>(std::lround(kSmoothing / cell));
  std::vector<Vector2d> line;
  for (int i = 0; i < n; ++i) {
    const int r = std::min({reach, i, n - 1 - i});
    Vector2d mean = Vector2d::Zero();
    for (int k = i - r; k <= i + r; ++k) mean += middle(arc, k, cell) / (2 * r + 1);
    if (!line.empty() && (mean - line.back()).norm() < kSpacing && i + 1 < n) continue;
    line.push_back(mean);
  }
  return line;
}

Vector2d normal_at(const std::vector<Vector2d>& line, int i) {
  const int n = static_cast<int>(line.size());
  const int a = std::max(0, i - 2), b = std::min(n - 1, i + 2);
  const Vector2d along = line[b] - line[a];
  const double length = along.norm();
  if (!(length > 0)) return {1, 0};
  return {-along.y() / length, along.x() / length};
}

TracedChain traced(const Arc& arc, const PremultipliedColours& colours, double cell) {
  std::vector<Vector2d> line = smooth_line(arc, cell);
  const int n = static_cast<int>(line.size());
  std::vector<EdgeProfile> profiles(n);
  std::vector<char> on_edge(n);
  // The second time with the directions of the edge itself.
  for (int round = 0; round < 2; ++round) {
    std::vector<Vector2d> moved = line;
    for (int i = 0; i < n; ++i) {
      const Vector2d normal = normal_at(line, i);
      profiles[i] = edge_profile(colours, line[i], normal);
      on_edge[i] = std::abs(profiles[i].offset) <= kFarthest;
      if (on_edge[i]) moved[i] += profiles[i].offset * normal;
    }
    line = std::move(moved);
  }
  TracedChain chain{{}, arc.from, arc.to};
  const bool is_loop = arc.from == arc.to;
  double count = 0;
  for (int i = 0; i < n; ++i) {
    const double to_node =
        std::min((line[i] - line.front()).norm(), (line[i] - line.back()).norm());
    if (!on_edge[i] || (!is_loop && to_node < kNodeReach)) continue;
    chain.points.push_back(line[i]);
    chain.contrast += profiles[i].contrast, chain.sharpness += profiles[i].sharpness, ++count;
  }
  if (count > 0) {
    chain.contrast /= count, chain.sharpness /= count;
  } else {
    const EdgeProfile& profile = profiles[n / 2];
    chain.points.push_back(line[n / 2]);
    chain.contrast = profile.contrast, chain.sharpness = profile.sharpness;
  }
  return chain;
}

}  // namespace

BoundaryGraph strong_runs(const PremultipliedColours& colours, const BoundaryGraph& graph,
                          const FieldGrid<float>& gradient, double cell,
                          const ChainOptions& options, const RunContext& context) {
  std::vector<std::vector<Run>> runs(graph.arcs.size());
  parallel_rows(context, static_cast<int>(graph.arcs.size()), kArcCost, [&](int a) {
    if (!may_be_strong(graph.arcs[a], gradient, kSteepness * options.contrast)) return;
    runs[a] = runs_of(graph.arcs[a], colours, cell, options);
  });
  BoundaryGraph strong;
  strong.nodes = graph.nodes;
  const auto free_end = [&](const Eigen::Vector2i& corner) {
    strong.nodes.push_back(corner);
    return static_cast<int>(strong.nodes.size()) - 1;
  };
  for (std::size_t a = 0; a < runs.size(); ++a) {
    const Arc& arc = graph.arcs[a];
    for (const Run& run : runs[a]) {
      Arc& part = strong.arcs.emplace_back();
      part.corners.assign(arc.corners.begin() + run.begin, arc.corners.begin() + run.last + 2);
      part.from = run.begin == 0 ? arc.from : free_end(part.corners.front());
      part.to = run.last + 1 == side_count(arc) ? arc.to : free_end(part.corners.back());
    }
  }
  return strong;
}

std::vector<TracedChain> traced_chains(const PremultipliedColours& colours,
                                       const BoundaryGraph& graph, double cell,
                                       const RunContext& context) {
  std::vector<TracedChain> chains(graph.arcs.size());
  parallel_rows(context, static_cast<int>(graph.arcs.size()), kArcCost,
                [&](int a) { chains[a] = traced(graph.arcs[a], colours, cell); });
  return chains;
}

}  // namespace quadrille
