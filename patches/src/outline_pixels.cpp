#include "outline_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quadrille {
namespace {

std::int64_t floor_sample(std::int64_t c) { return c >> kFixedBits; }
std::int64_t ceil_sample(std::int64_t c) { return (c + kFixedOne - 1) >> kFixedBits; }

/// Sum of the positions of the bits that are set.
int sum_of_positions(std::uint16_t bits) {
  return std::popcount<std::uint16_t>(bits & 0xAAAA) +
         2 * std::popcount<std::uint16_t>(bits & 0xCCCC) +
         4 * std::popcount<std::uint16_t>(bits & 0xF0F0) +
         8 * std::popcount<std::uint16_t>(bits & 0xFF00);
}

/// Bits begin ... end - 1.
std::uint16_t bit_range(int begin, int end) {
  return static_cast<std::uint16_t>(((1u << end) - 1) & ~((1u << begin) - 1));
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
  extents_.assign(height, {width(), 0});
  for (const Pixel& p : pixels_) {
    Extent& extent = extents_[p.y - window.y_begin];
    extent.begin = std::min(extent.begin, p.x - window.x_begin);
    extent.end = std::max(extent.end, p.x - window.x_begin + 1);
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

bool OutlinePixels::reaches(const SampleWindow& bounds) const {
  for (int y = bounds.y_begin; y < bounds.y_end; ++y) {
    const Extent& extent = extents_[y - window_.y_begin];
    if (extent.begin < bounds.x_end - window_.x_begin &&
        bounds.x_begin - window_.x_begin < extent.end) {
      return true;
    }
  }
  return false;
}

void OutlinePixels::take(const PatchScan& scan, int patch, std::vector<Share>& shares) {
  shares.clear();
  if (pixels_.empty()) return;
  const SampleWindow bounds = intersection(scan.touched(patch), window_);
  if (bounds.empty() || !reaches(bounds)) return;
  scan.spans(patch, bounds, kDivisionBits, spans_);
  touched_.clear();
  for (const SampleSpan& s : spans_) {
    const int row = bounds.y_begin - window_.y_begin + (s.y >> kDivisionBits);
    const int sub_row = s.y & (kDivision - 1);
    const int left = bounds.x_begin - window_.x_begin;  // of the spans' first sample
    const int first = std::max(left + (s.x_begin >> kDivisionBits), extents_[row].begin);
    const int last = std::min(left + ((s.x_end - 1) >> kDivisionBits) + 1, extents_[row].end);
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
      const int count = std::popcount(bits);
      sum.count += count;
      sum.x += sum_of_positions(bits);
      sum.y += count * sub_row;
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
