#include "curve_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille {

using Eigen::Vector2d;

CurveIndex::CurveIndex(std::vector<CurveSegment> segments, double cell)
    : segments_(std::move(segments)), cell_(cell) {
  if (segments_.empty()) return;
  low_ = Vector2d::Constant(INFINITY);
  Vector2d high = Vector2d::Constant(-INFINITY);
  for (const CurveSegment& s : segments_) {
    low_ = low_.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  columns_ = static_cast<int>((high.x() - low_.x()) / cell_) + 1;
  rows_ = static_cast<int>((high.y() - low_.y()) / cell_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (int i = 0; i < static_cast<int>(segments_.size()); ++i) {
    const auto& [curve, a, b, s] = segments_[i];
    const Vector2d first = (a.cwiseMin(b) - low_) / cell_, last = (a.cwiseMax(b) - low_) / cell_;
    for (int y = static_cast<int>(first.y()); y <= static_cast<int>(last.y()); ++y) {
      for (int x = static_cast<int>(first.x()); x <= static_cast<int>(last.x()); ++x) {
        cells_[static_cast<std::size_t>(y) * columns_ + x].push_back(i);
      }
    }
  }
}

std::optional<CurveIndex::Place> CurveIndex::nearest(const Vector2d& p, double reach) const {
  std::optional<Place> best;
  const auto cell = [&](double c, int count) {
    return std::clamp(static_cast<int>(std::floor(c / cell_)), 0, count - 1);
  };
  if (segments_.empty()) return best;
  const Vector2d q = p - low_;
  for (int y = cell(q.y() - reach, rows_); y <= cell(q.y() + reach, rows_); ++y) {
    for (int x = cell(q.x() - reach, columns_); x <= cell(q.x() + reach, columns_); ++x) {
      for (const int i : cells_[static_cast<std::size_t>(y) * columns_ + x]) {
        const auto& [curve, a, b, s] = segments_[i];
        const Vector2d along = b - a;
        const double length2 = along.squaredNorm();
        const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
        const double distance = (a + t * along - p).norm();
        if (distance <= (best ? best->distance : reach)) {
          if (best && distance == best->distance) continue;
          best = {curve, s + t * std::sqrt(length2), distance};
        }
      }
    }
  }
  return best;
}

}  // namespace quadrille
