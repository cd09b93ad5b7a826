#include "chain_rungs.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Arc = BoundaryGraph::Arc;

constexpr double kLongest = 40;      // pixels
constexpr double kEnd = 1.5;         // pixels of an arc that count as its end
constexpr double kLow = 0.5;         // of the gradient at the ends, that in the middle
constexpr double kArm = 0.75;        // pixels to where the colours on both sides are taken
constexpr double kDirectionArm = 3;  // pixels on either side that tell an arc's direction

/// The gradient along an arc.
std::vector<float> gradient_along(const Arc& arc, const FieldGrid<float>& gradient) {
  const auto at = [&](int x, int y) {
    return gradient(std::clamp(x, 0, gradient.width - 1), std::clamp(y, 0, gradient.height - 1));
  };
  std::vector<float> along;
  for (std::size_t k = 0; k + 1 < arc.corners.size(); ++k) {
    const Eigen::Vector2i a = arc.corners[k], b = arc.corners[k + 1];
    const int x = std::min(a.x(), b.x()), y = std::min(a.y(), b.y());
    along.push_back(std::max(at(x, y), a.x() == b.x() ? at(x - 1, y) : at(x, y - 1)));
  }
  return along;
}

/// The difference of the colours on both sides of an arc about its k-th side.
double difference_across(const Arc& arc, int k, const PremultipliedColours& colours, double cell) {
  const int reach = static_cast<int>(kDirectionArm / cell);
  const int last = static_cast<int>(arc.corners.size()) - 1;
  const Eigen::Vector2i a = arc.corners[std::max(0, k - reach)];
  const Eigen::Vector2i b = arc.corners[std::min(last, k + 1 + reach)];
  const Vector2d chord = (b - a).cast<double>();
  const Vector2d arm = kArm * Vector2d(-chord.y(), chord.x()).normalized();
  const Vector2d p = (arc.corners[k] + arc.corners[k + 1]).cast<double>() * (0.5 * cell);
  return (colours.at(p + arm) - colours.at(p - arm)).norm();
}

bool is_rung(const Arc& arc, const PremultipliedColours& colours, const FieldGrid<float>& gradient,
             double cell, double contrast) {
  const double length = (arc.corners.size() - 1) * cell;
  if (arc.from == arc.to || length > kLongest) return false;
  const std::vector<float> along = gradient_along(arc, gradient);
  const auto end = std::min<std::ptrdiff_t>(std::ssize(along), std::lround(kEnd / cell));
  const float at_begin = *std::max_element(along.begin(), along.begin() + end);
  const float at_end = *std::max_element(along.end() - end, along.end());
  const auto lowest = std::min_element(along.begin(), along.end());
  if (*lowest > kLow * std::min(at_begin, at_end)) return false;
  const int k = static_cast<int>(lowest - along.begin());
  return difference_across(arc, k, colours, cell) < contrast;
}

}  // namespace

void leave_out_rungs(BoundaryGraph& graph, const PremultipliedColours& colours,
                     const FieldGrid<float>& gradient, double cell, double contrast) {
  std::erase_if(graph.arcs,
                [&](const Arc& arc) { return is_rung(arc, colours, gradient, cell, contrast); });
  join_pairs(graph);
}

}  // namespace quadrille
