#include "tile_outlines.h"

#include <algorithm>

namespace quadrille {

void TileOutlines::start(const PatchScan& scan, const SampleWindow& window) {
  scan_ = &scan;
  window_ = window;
  crossed_.resize(std::max<std::size_t>(crossed_.size(), scan.patches().mesh.edge_count()));
  if (++tile_ == 0) {  // numbers begin again
    std::fill(crossed_.begin(), crossed_.end(), Crossed{});
    tile_ = 1;
  }
  runs_.clear();
  columns_.clear();
}

void TileOutlines::cross(int edge) {
  Crossed& crossed = crossed_[edge];
  if (crossed.tile == tile_) return;
  crossed.tile = tile_;
  crossed.first = static_cast<int>(runs_.size());
  const auto line = scan_->polyline(edge);
  for (std::size_t i = 1; i < line.size();) {
    const std::size_t begin = i - 1;
    const bool down = line[i].y > line[begin].y;
    while (i < line.size() && (down ? line[i].y > line[i - 1].y : line[i].y < line[i - 1].y)) ++i;
    if (begin == i - 1) {  // level
      ++i;
    } else if (down) {
      add_run(&line[begin], &line[i - 1], true);
    } else {
      add_run(&line[i - 1], &line[begin], false);
    }
  }
  crossed.last = static_cast<int>(runs_.size());
}

/// Adds points that run down from `top` to `bottom`, which lie one way or the other in memory.
void TileOutlines::add_run(const FixedPoint* top, const FixedPoint* bottom, bool down) {
  const std::int64_t begin =
      std::max<std::int64_t>(first_center(top->y, kFixedBits), window_.y_begin);
  const std::int64_t end =
      std::min<std::int64_t>(first_center(bottom->y, kFixedBits), window_.y_end);
  if (begin >= end) return;
  const int step = bottom > top ? 1 : -1;
  const std::size_t first = columns_.size();
  columns_.resize(first + static_cast<std::size_t>(end - begin));
  int* column = columns_.data() + first;
  const FixedPoint* p = top;
  for (std::int64_t row = begin; row < end; ++row) {
    const std::int64_t center = row * kFixedOne + kFixedOne / 2;
    while (p[step].y <= center) p += step;
    const std::int64_t x = column_at(p[0], p[step], center);
    *column++ = static_cast<int>(std::clamp<std::int64_t>(x, window_.x_begin, window_.x_end) -
                                 window_.x_begin);
  }
  runs_.push_back(
      {static_cast<int>(begin - window_.y_begin), static_cast<int>(end - begin), down, first});
}

/// The first sample whose centre is not left of the segment from a down to b where it crosses the
/// height `center`: ceil(((x0 - 1/2) dy + (center - y0) dx) / dy).
std::int64_t TileOutlines::column_at(const FixedPoint& a, const FixedPoint& b,
                                     std::int64_t center) {
  constexpr std::int64_t kHalf = kFixedOne / 2, kNarrow = std::int64_t{1} << 25;
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  const std::int64_t whole = a.x >> kFixedBits, rest = (a.x & (kFixedOne - 1)) - kHalf;
  if (std::max(dy, std::abs(dx)) < kNarrow) {
    // Both are whole numbers below 2^52, so the rounded quotient of doubles never reaches a whole
    // number that the true one does not.
    const double quotient =
        static_cast<double>(rest * dy + (center - a.y) * dx) / static_cast<double>(dy * kFixedOne);
    const int truncated = static_cast<int>(quotient);
    return whole + truncated + (quotient > truncated);
  }
  const __int128 numerator =
      static_cast<__int128>(rest) * dy + static_cast<__int128>(center - a.y) * dx;
  const __int128 divisor = static_cast<__int128>(dy) * kFixedOne;
  return whole + static_cast<std::int64_t>(numerator / divisor + (numerator % divisor > 0));
}

bool TileOutlines::Side::insert(const Run* r) {
  if (count == kMost) return false;
  int at = count++;
  for (; at > 0 && run[at - 1]->row > r->row; --at) run[at] = run[at - 1];
  run[at] = r;
  return true;
}

bool TileOutlines::Side::gapless() const {
  for (int i = 1; i < count; ++i) {
    if (run[i]->row != run[i - 1]->row + run[i - 1]->count) return false;
  }
  return count > 0;
}

/// Most patches have one left and one right side in every row.
bool TileOutlines::simple_spans(int patch, std::vector<SampleSpan>& found) {
  const QuadMesh& mesh = scan_->patches().mesh;
  for (int k = 0; k < 4; ++k) cross(mesh.edge(4 * patch + k));
  Side left, right;
  for (int k = 0; k < 4; ++k) {
    const int h = 4 * patch + k, e = mesh.edge(h);
    // Where an outline runs up, its patch lies on the right.
    const bool left_is_down = (mesh.halfedge(e) == h) != (scan_->orientation() > 0);
    for (int r = crossed_[e].first; r < crossed_[e].last; ++r) {
      if (!(runs_[r].down == left_is_down ? left : right).insert(&runs_[r])) return false;
    }
  }
  if (left.count == 0 && right.count == 0) return true;
  if (!left.gapless() || !right.gapless() || left.begin() != right.begin() ||
      left.end() != right.end()) {
    return false;
  }
  const auto gather = [&](const Side& side, int* columns) {
    for (int i = 0; i < side.count; ++i) {
      const int* const from = columns_.data() + side.run[i]->first;
      for (int j = 0; j < side.run[i]->count; ++j) *columns++ = from[j];
    }
  };
  const int rows = left.end() - left.begin();
  left_.resize(std::max(left_.size(), static_cast<std::size_t>(rows)));
  right_.resize(left_.size());
  gather(left, left_.data());
  gather(right, right_.data());
  found.resize(rows);
  int count = 0;
  for (int i = 0; i < rows; ++i) {
    found[count] = {left.begin() + i, left_[i], right_[i]};
    count += left_[i] < right_[i];
  }
  found.resize(count);
  return true;
}

void TileOutlines::spans(int patch, std::vector<SampleSpan>& found) {
  found.clear();
  if (simple_spans(patch, found)) return;
  const SampleWindow part = intersection(scan_->bounds(patch), window_);
  scan_->spans(patch, part, 0, found);
  const int left = part.x_begin - window_.x_begin, top = part.y_begin - window_.y_begin;
  for (SampleSpan& s : found) s = {s.y + top, s.x_begin + left, s.x_end + left};
}

}  // namespace quadrille
