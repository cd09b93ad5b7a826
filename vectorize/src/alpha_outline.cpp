// Lorensen, Cline, Marching cubes, 1987, in the plane.
#include "quadrille/alpha_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace quadrille {
namespace {

constexpr int kUnits = 64;  // grid units per pixel
// Crossings keep this distance from the nodes, so that no two of them coincide and lines of one
// cell never touch.
constexpr int kClearance = 2;

/// Alpha at the nodes of a grid of lines through the pixel centres, the picture's sides, and one
/// line further out all around, which is outside. The sides carry the alpha of the pixels beside
/// them. Node (0, 0) is the corner of the line further out.
class NodeGrid {
 public:
  explicit NodeGrid(const Raster& picture) : picture_(picture) {}

  int columns() const { return picture_.width + 4; }
  int rows() const { return picture_.height + 4; }

  float alpha(int i, int j) const {
    if (is_beyond(i, picture_.width) || is_beyond(j, picture_.height)) return -1;
    if (!picture_.has_alpha()) return 1;
    return picture_.pixel(std::clamp(i - 2, 0, picture_.width - 1),
                          std::clamp(j - 2, 0, picture_.height - 1))[3];
  }
  bool inside(int i, int j) const { return alpha(i, j) >= kOpaqueAlpha; }

  /// The crossing between two neighbouring nodes of which one is inside; on the picture's side
  /// when the other one lies beyond.
  Eigen::Vector2d crossing(int i, int j, int k, int l) const {
    const double x0 = place(i, picture_.width), y0 = place(j, picture_.height);
    const double x1 = place(k, picture_.width), y1 = place(l, picture_.height);
    const float a = alpha(i, j), b = alpha(k, l);
    const int steps = static_cast<int>(std::abs(x1 - x0) + std::abs(y1 - y0));
    double t = 0;  // towards the second node
    if (steps > 0) {
      const double exact = (kOpaqueAlpha - a) / (b - a) * steps;
      t = std::clamp<double>(std::round(exact), kClearance, steps - kClearance) / steps;
    }
    return Eigen::Vector2d(x0 + t * (x1 - x0), y0 + t * (y1 - y0)) / kUnits;
  }

 private:
  static bool is_beyond(int i, int size) { return i == 0 || i == size + 3; }
  /// In grid units; nodes beyond a side lie on it.
  static double place(int i, int size) {
    return std::clamp((i - 2) * kUnits + kUnits / 2, 0, size * kUnits);
  }
  const Raster& picture_;
};

/// Side k of a cell joins corner k to corner k + 1; corners run (0,0), (1,0), (1,1), (0,1).
constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};

/// A line through a cell enters by side `from` and leaves by side `to`, with the inside on its
/// positive side.
struct Passage {
  int from, to;
};

int passages(const NodeGrid& grid, int x, int y, std::array<Passage, 2>& found) {
  bool in[4];
  int inside = 0;
  for (int k = 0; k < 4; ++k) inside += in[k] = grid.inside(x + kCornerX[k], y + kCornerY[k]);
  if (inside == 0 || inside == 4) return 0;
  // Along the cell's outline the line enters where the inside ends.
  int entries[2], exits[2], count = 0, exit_count = 0;
  for (int k = 0; k < 4; ++k) {
    const bool here = in[k], next = in[(k + 1) & 3];
    if (here && !next) entries[count++] = k;
    if (!here && next) exits[exit_count++] = k;
  }
  if (count == 1) {
    found[0] = {entries[0], exits[0]};
    return 1;
  }
  float sum = 0;
  for (int k = 0; k < 4; ++k) sum += grid.alpha(x + kCornerX[k], y + kCornerY[k]);
  const bool joined = sum >= 4 * kOpaqueAlpha;
  for (int i = 0; i < 2; ++i) {
    // An inside corner lies between the exit before it and the entry after it; an outside corner
    // between the entry before it and the exit after it.
    const int k = entries[i];
    found[i] = {k, joined ? (k + 1) & 3 : (k + 3) & 3};
  }
  return 2;
}

class Tracer {
 public:
  explicit Tracer(const Raster& picture) : grid_(picture) {
    std::array<Passage, 2> found;
    for (int y = 0; y + 1 < grid_.rows(); ++y) {
      for (int x = 0; x + 1 < grid_.columns(); ++x) {
        const int count = passages(grid_, x, y, found);
        for (int i = 0; i < count; ++i) {
          steps_.push_back({edge_of(x, y, found[i].from), edge_of(x, y, found[i].to)});
        }
      }
    }
    std::sort(steps_.begin(), steps_.end(),
              [](const Step& a, const Step& b) { return a.from < b.from; });
  }

  std::vector<Loop> loops() const {
    std::vector<Loop> loops;
    std::vector<char> done(steps_.size(), 0);
    for (std::size_t start = 0; start < steps_.size(); ++start) {
      if (done[start]) continue;
      Loop loop;
      for (std::size_t i = start; !done[i]; i = step_from(steps_[i].to)) {
        done[i] = 1;
        const Eigen::Vector2d p = crossing(steps_[i].from);
        // At the picture's corner two crossings coincide.
        if (loop.empty() || (loop.back() != p && loop.front() != p)) loop.push_back(p);
      }
      loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  /// From one grid edge that the line crosses to the next.
  struct Step {
    std::int64_t from, to;
  };

  std::size_t step_from(std::int64_t edge) const {
    const auto at = std::lower_bound(steps_.begin(), steps_.end(), edge,
                                     [](const Step& s, std::int64_t e) { return s.from < e; });
    return at - steps_.begin();
  }

  /// Grid edges by their first node: even ones run right, odd ones down.
  std::int64_t edge_of(int x, int y, int side) const {
    const std::int64_t node = std::int64_t{1} * y * grid_.columns() + x;
    switch (side) {
      case 0:
        return 2 * node;
      case 1:
        return 2 * (node + 1) + 1;
      case 2:
        return 2 * (node + grid_.columns());
      default:
        return 2 * node + 1;
    }
  }

  Eigen::Vector2d crossing(std::int64_t e) const {
    const int i = static_cast<int>(e / 2 % grid_.columns());
    const int j = static_cast<int>(e / 2 / grid_.columns());
    return e % 2 == 0 ? grid_.crossing(i, j, i + 1, j) : grid_.crossing(i, j, i, j + 1);
  }

  NodeGrid grid_;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<Loop> alpha_outline(const Raster& picture, double least_area) {
  check_raster(picture);
  std::vector<Loop> loops = Tracer(picture).loops();
  double largest = 0;
  for (const Loop& loop : loops) largest = std::max(largest, signed_area(loop));
  const double least = std::min(least_area, largest);
  std::erase_if(loops, [&](const Loop& loop) { return std::abs(signed_area(loop)) < least; });
  return loops;
}

bool is_frame(const std::vector<Loop>& outline, double width, double height, double least_area) {
  return outline.size() == 1 && width * height - signed_area(outline[0]) <= least_area;
}

}  // namespace quadrille
