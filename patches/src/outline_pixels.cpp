#include "outline_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bit_range.h"

namespace quadrille {
namespace {

std::int64_t floor_sample(std::int64_t c) { return c >> kFixedBits; }
std::int64_t ceil_sample(std::int64_t c) { return (c + kFixedOne - 1) >> kFixedBits; }

/// Number of the bits that are set, and the sum of their positions.
struct BitSums {
  int count, positions;
};
BitSums bit_sums(unsigned bits) {
  BitSums sums = {0, 0};
  // Run by run: mostly there is one.
  while (bits != 0) {
    const int begin = std::countr_zero(bits), end = begin + std::countr_one(bits >> begin);
    sums.count += end - begin;
    sums.positions += (begin + end - 1) * (end - begin) / 2;
    bits &= ~0u << end;
  }
  return sums;
}

}  // namespace

void OutlinePixels::find(const PatchScan& scan, std::span<const int> patches,
                         const SampleWindow& window) {
  window_ = window;
  pixels_.clear();
  const int height = window.y_end - window.y_begin;
  index_.assign(width() * height, -1);
  const QuadMesh& mesh = scan.patches().mesh;
  for (const int q : patches) {
    for (int k = 0; k < 4; ++k) {
      const int e = mesh.edge(4 * q + k);
      if (!mesh.is_border(e) && !mesh.is_tear(e)) continue;
      const auto line = scan.polyline(e);
      for (std::size_t i = 1; i < line.size(); ++i) mark_segment(line[i - 1], line[i]);
    }
  }
  sums_.assign(pixels_.size(), {});
  rows_.assign(height, {width(), 0, {}});
  for (const Pixel& p : pixels_) {
    Row& row = rows_[p.y - window_.y_begin];
    const int x = p.x - window_.x_begin;
    row.begin = std::min(row.begin, x);
    row.end = std::max(row.end, x + 1);
    row.bits[x / 64] |= std::uint64_t{1} << x % 64;
  }
}

void OutlinePixels::mark_segment(const FixedPoint& a, const FixedPoint& b) {
  const FixedPoint low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
  const double slope = high.y > low.y ? double(high.x - low.x) / double(high.y - low.y) : 0.0;
  const std::int64_t first = std::max<std::int64_t>(floor_sample(low.y), window_.y_begin);
  const std::int64_t last = std::min<std::int64_t>(ceil_sample(high.y), window_.y_end);
  for (std::int64_t row = first; row < last; ++row) {
    // The part of the segment inside the row.
    double x0 = low.x, x1 = high.x;
    if (low.y < row * kFixedOne) x0 = low.x + slope * (row * kFixedOne - low.y);
    if (high.y > (row + 1) * kFixedOne) x1 = low.x + slope * ((row + 1) * kFixedOne - low.y);
    const double left = std::floor(std::min(x0, x1) / kFixedOne);
    const double right = std::ceil(std::max(x0, x1) / kFixedOne);
    const int begin = static_cast<int>(std::max<double>(left, window_.x_begin));
    const int end = static_cast<int>(std::min<double>(right, window_.x_end));
    for (int x = begin; x < end; ++x) mark(x, static_cast<int>(row));
  }
}

void OutlinePixels::mark(int x, int y) {
  int& index = index_[(y - window_.y_begin) * width() + (x - window_.x_begin)];
  if (index >= 0) return;
  index = static_cast<int>(pixels_.size());
  pixels_.push_back({x, y});
}

/// The rows of a part of the window from the first to the last that has crossed pixels in it.
SampleWindow OutlinePixels::crossed_part(const SampleWindow& bounds) const {
  std::array<std::uint64_t, kBlockSide / 64> columns = {};
  for (int x = bounds.x_begin - window_.x_begin; x < bounds.x_end - window_.x_begin; ++x) {
    columns[x / 64] |= std::uint64_t{1} << x % 64;
  }
  SampleWindow part = {bounds.x_begin, bounds.y_end, bounds.x_end, bounds.y_begin};
  for (int y = bounds.y_begin; y < bounds.y_end; ++y) {
    std::uint64_t common = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      common |= columns[i] & rows_[y - window_.y_begin].bits[i];
    }
    if (common == 0) continue;
    part.y_begin = std::min(part.y_begin, y);
    part.y_end = y + 1;
  }
  return part;
}

void OutlinePixels::take(const PatchScan& scan, int patch, std::vector<Share>& shares) {
  shares.clear();
  if (pixels_.empty()) return;
  const SampleWindow bounds = crossed_part(intersection(scan.touched(patch), window_));
  if (bounds.empty()) return;
  scan.spans(patch, bounds, kDivisionBits, spans_);
  touched_.clear();
  for (const SampleSpan& s : spans_) {
    const int row = bounds.y_begin - window_.y_begin + (s.y >> kDivisionBits);
    const int sub_row = s.y & (kDivision - 1);
    const int left = bounds.x_begin - window_.x_begin;  // of the spans' first sample
    const int first = std::max(left + (s.x_begin >> kDivisionBits), rows_[row].begin);
    const int last = std::min(left + ((s.x_end - 1) >> kDivisionBits) + 1, rows_[row].end);
    for (int x = first; x < last; ++x) {
      const int index = index_[row * width() + x];
      if (index < 0) continue;
      std::uint16_t& taken = pixels_[index].taken[sub_row];
      const int corner = (x - left) * kDivision;
      const std::uint16_t bits = ~taken & bit_range(std::max(s.x_begin - corner, 0),
                                                    std::min(s.x_end - corner, kDivision));
      if (bits == 0) continue;
      taken |= bits;
      Sum& sum = sums_[index];
      if (sum.count == 0) touched_.push_back(index);
      const BitSums added = bit_sums(bits);
      sum.count += added.count;
      sum.x += added.positions;
      sum.y += added.count * sub_row;
    }
  }
  for (const int index : touched_) {
    Sum& sum = sums_[index];
    const float n = static_cast<float>(sum.count);
    shares.push_back({index, n / (kDivision * kDivision), (sum.x / n + 0.5f) / kDivision,
                      (sum.y / n + 0.5f) / kDivision});
    sum = {};
  }
}

}  // namespace quadrille
