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
  const std::size_t rows = window.y_end - window.y_begin;
  left_.resize(std::max(left_.size(), rows));
  right_.resize(std::max(right_.size(), rows));
}

void TileOutlines::cross(int edge) {
  Crossed& crossed = crossed_[edge];
  if (crossed.tile == tile_) return;
  crossed.tile = tile_;
  crossed.first = static_cast<int>(runs_.size());
  const auto line = scan_->polyline(edge);
  for (std::size_t i = 1; i < line.size();) {
    if (line[i].y == line[i - 1].y) {
      ++i;
      continue;
    }
    const bool down = line[i].y > line[i - 1].y;
    const std::size_t begin = i - 1, first = columns_.size();
    while (i < line.size() && line[i].y != line[i - 1].y && (line[i].y > line[i - 1].y) == down)
      ++i;
    const FixedPoint& top = down ? line[begin] : line[i - 1];
    const int row =
        static_cast<int>(std::max<std::int64_t>(first_center(top.y, kFixedBits), window_.y_begin));
    if (down) {
      for (std::size_t j = begin + 1; j < i; ++j) scan_segment(line[j - 1], line[j]);
    } else {
      for (std::size_t j = i - 1; j > begin; --j) scan_segment(line[j], line[j - 1]);
    }
    const int count = static_cast<int>(columns_.size() - first);
    if (count > 0) runs_.push_back({row - window_.y_begin, count, down, first});
  }
  crossed.last = static_cast<int>(runs_.size());
}

/// Appends the columns of a segment that runs down, row by row: the first sample whose centre is
/// not left of it, ceil(((x0 - 1/2) dy + (center - y0) dx) / dy). Numerators are whole numbers
/// below 2^52 and the divisor is too, so the rounded quotient of doubles never reaches a whole
/// number that the true one does not.
void TileOutlines::scan_segment(const FixedPoint& a, const FixedPoint& b) {
  constexpr std::int64_t kHalf = kFixedOne / 2, kNarrow = std::int64_t{1} << 25;
  const std::int64_t begin = std::max<std::int64_t>(first_center(a.y, kFixedBits), window_.y_begin);
  const std::int64_t end = std::min<std::int64_t>(first_center(b.y, kFixedBits), window_.y_end);
  if (begin >= end) return;
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  const std::int64_t first = (a.x >> kFixedBits) - window_.x_begin;
  const std::int64_t width = window_.x_end - window_.x_begin;
  if (std::max(dy, std::abs(dx)) >= kNarrow) {
    append_row_crossings(a, b, begin, end, window_, columns_);
    return;
  }
  const double divisor = static_cast<double>(dy * kFixedOne);
  const double step = static_cast<double>(dx * kFixedOne);
  const double numerator = static_cast<double>(((a.x & (kFixedOne - 1)) - kHalf) * dy +
                                               (begin * kFixedOne + kHalf - a.y) * dx);
  const std::size_t before = columns_.size();
  const int count = static_cast<int>(end - begin);
  columns_.resize(before + count);
  int* const columns = columns_.data() + before;
  for (int i = 0; i < count; ++i) {
    const double quotient = (numerator + i * step) / divisor;
    const int whole = static_cast<int>(quotient);
    columns[i] = whole + (quotient > whole);
  }
  for (int i = 0; i < count; ++i) {
    columns[i] = static_cast<int>(std::clamp<std::int64_t>(first + columns[i], 0, width));
  }
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
  gather(left, left_.data());
  gather(right, right_.data());
  const int rows = left.end() - left.begin();
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
  if (!simple_spans(patch, found)) scan_->spans(patch, window_, 0, found);
}

}  // namespace quadrille
