#include "paper_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "angle_field.h"
#include "parallel.h"

namespace quadrille {
namespace {

constexpr int kMaxRounds = 30;
// Of Gauss-Seidel, for "updating the cross field by minimizing Eq. 3" from the pixels around.
constexpr int kSweepsPerRound = 10;

/// Angles in quarter turns, the period jumps p to the right and q downward, and Eq. 3's weights.
struct PaperField {
  FieldGrid<float> turns, weight;
  FieldGrid<int> p, q;
};

/// Eq. 1 and 2.
PaperField start(const FeatureTensor& features) {
  const int w = features.gradient.width, h = features.gradient.height;
  PaperField field{{w, h}, {w, h}, {w, h}, {w, h}};
  float largest = 0;
  for (const Eigen::Vector2f& g : features.gradient.data) largest = std::max(largest, g.norm());
  for (std::size_t i = 0; i < field.turns.data.size(); ++i) {
    const Eigen::Vector2f& g = features.gradient.data[i];
    field.turns.data[i] = std::atan2(g.y(), g.x()) / (2 * std::atan(1.0f));
    field.weight.data[i] = std::exp(largest > 0 ? g.norm() / largest : 0.0f);
  }
  const auto jump = [](float difference) { return static_cast<int>(std::lround(difference)); };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const float here = field.turns(x, y);
      if (x + 1 < w) field.p(x, y) = jump(field.turns(x + 1, y) - here);
      if (y + 1 < h) field.q(x, y) = jump(field.turns(x, y + 1) - here);
    }
  }
  return field;
}

/// Eq. 3's minimum over the angles of one colour of the checkerboard, w, p and q fixed.
void relax(PaperField& field, int colour, const RunContext& context) {
  const int w = field.turns.width, h = field.turns.height;
  auto& u = field.turns;
  parallel_rows(context, h, w, [&](int y) {
    for (int x = (y + colour) & 1; x < w; x += 2) {
      float sum = 0, weight = 0;
      const auto add = [&](float edge_weight, float value) {
        sum += edge_weight * value;
        weight += edge_weight;
      };
      if (x + 1 < w) add(field.weight(x, y), u(x + 1, y) - field.p(x, y));
      if (y + 1 < h) add(field.weight(x, y), u(x, y + 1) - field.q(x, y));
      if (x > 0) add(field.weight(x - 1, y), u(x - 1, y) + field.p(x - 1, y));
      if (y > 0) add(field.weight(x, y - 1), u(x, y - 1) + field.q(x, y - 1));
      if (weight > 0) u(x, y) = sum / weight;
    }
  });
}

/// Eq. 4.
std::vector<std::array<int, 2>> find_singularities(const PaperField& field) {
  std::vector<std::array<int, 2>> found;
  for (int y = 0; y + 1 < field.p.height; ++y) {
    for (int x = 0; x + 1 < field.p.width; ++x) {
      if (field.p(x, y) - field.p(x, y + 1) - field.q(x, y) + field.q(x + 1, y) != 0) {
        found.push_back({x, y});
      }
    }
  }
  return found;
}

/// Lines 7 and 8 of Alg. 1: the jump across the largest difference around the singularity follows
/// that difference.
void push(PaperField& field, int x, int y) {
  const auto& u = field.turns;
  struct Edge {
    int* jump;
    float difference;
  };
  const std::array<Edge, 4> edges = {
      Edge{&field.p(x, y), u(x + 1, y) - u(x, y) - field.p(x, y)},
      Edge{&field.p(x, y + 1), u(x + 1, y + 1) - u(x, y + 1) - field.p(x, y + 1)},
      Edge{&field.q(x, y), u(x, y + 1) - u(x, y) - field.q(x, y)},
      Edge{&field.q(x + 1, y), u(x + 1, y + 1) - u(x + 1, y) - field.q(x + 1, y)}};
  const Edge& widest =
      *std::ranges::max_element(edges, {}, [](const Edge& e) { return std::abs(e.difference); });
  *widest.jump += widest.difference > 0 ? 1 : -1;
}

}  // namespace

ComplexGrid paper_field(const FeatureTensor& features, const RunContext& context) {
  PaperField field = start(features);
  std::vector<std::array<int, 2>> before;
  for (int round = 0; round < kMaxRounds; ++round) {
    context.progress("cross field", static_cast<double>(round) / kMaxRounds);
    for (int sweep = 0; sweep < kSweepsPerRound; ++sweep) {
      relax(field, 0, context);
      relax(field, 1, context);
    }
    std::vector<std::array<int, 2>> found = find_singularities(field);
    if (round > 0 && found == before) break;
    for (const auto& [x, y] : found) push(field, x, y);
    before = std::move(found);
  }
  ComplexGrid z(field.turns.width, field.turns.height);
  for (std::size_t i = 0; i < z.data.size(); ++i) {
    z.data[i] = from_turns(principal(field.turns.data[i]));
  }
  return z;
}

}  // namespace quadrille
