#include "inside_test.h"

#include <algorithm>
#include <cmath>

namespace quadrille {

using Eigen::Vector2d;

InsideTest::InsideTest(const std::vector<Loop>& outline) {
  double bottom = -INFINITY;
  std::size_t count = 0;
  top_ = INFINITY;
  for (const Loop& loop : outline) {
    for (const Vector2d& p : loop) {
      top_ = std::min(top_, p.y());
      bottom = std::max(bottom, p.y());
    }
    count += loop.size();
  }
  if (count == 0) return;
  const int strips = static_cast<int>(std::clamp<std::size_t>(count / 4, 1, 65536));
  strip_height_ = std::max((bottom - top_) / strips, 1e-300);
  strips_.resize(strips);
  const auto strip = [&](double y) {
    return std::min(static_cast<int>((y - top_) / strip_height_), strips - 1);
  };
  for (const Loop& loop : outline) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Side side{loop[i], loop[(i + 1) % loop.size()]};
      if (side.upper.y() == side.lower.y()) continue;
      if (side.upper.y() > side.lower.y()) std::swap(side.upper, side.lower);
      for (int s = strip(side.upper.y()); s <= strip(side.lower.y()); ++s) {
        strips_[s].push_back(side);
      }
    }
  }
}

bool InsideTest::operator()(const Vector2d& p) const {
  const double strip = (p.y() - top_) / strip_height_;
  if (strips_.empty() || strip < 0 || strip > static_cast<double>(strips_.size())) return false;
  const std::size_t last = strips_.size() - 1;
  bool inside = false;
  for (const Side& side : strips_[std::min(static_cast<std::size_t>(strip), last)]) {
    if (side.upper.y() > p.y() || side.lower.y() <= p.y()) continue;
    const Vector2d along = side.lower - side.upper, offset = p - side.upper;
    if (along.x() * offset.y() - along.y() * offset.x() < 0) inside = !inside;
  }
  return inside;
}

}  // namespace quadrille
