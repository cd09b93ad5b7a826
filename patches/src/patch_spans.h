#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <span>
#include <vector>

#include "patch_scan.h"
#include "tile_outlines.h"

namespace quadrille {

/// The samples of those patches of a scan that were asked for so far, kept from window to window.
class PatchSpans {
 public:
  void start(std::size_t patch_count) {
    ranges_.assign(patch_count, {});
    spans_.clear();
  }
  std::size_t span_count() const { return spans_.size(); }

  /// Finds the spans of those patches `wanted` that are missing and not too large; the scan must
  /// have them. `for_each(count, body)` calls body(0) ... body(count - 1).
  template <class ForEach>
  void add(const PatchScan& scan, std::span<const int> wanted, const ForEach& for_each) {
    find_missing(scan, wanted);
    constexpr std::size_t kRange = 256;
    const std::size_t range_count = (missing_.size() + kRange - 1) / kRange;
    found_.resize(std::max(found_.size(), range_count));
    for_each(range_count, [&](std::size_t r) {
      const std::size_t begin = r * kRange, end = std::min(begin + kRange, missing_.size());
      find(scan, std::span(missing_).subspan(begin, end - begin), found_[r]);
    });
    for (std::size_t r = 0; r < range_count; ++r) {
      const std::size_t begin = r * kRange, end = std::min(begin + kRange, missing_.size());
      append(std::span(missing_).subspan(begin, end - begin), found_[r]);
    }
  }

  /// Whether the patch's spans are kept.
  bool has(int patch) const { return ranges_[patch].known; }
  /// All its spans, in samples of the whole grid, rows in ascending order.
  std::span<const SampleSpan> of(int patch) const {
    return std::span(spans_).subspan(ranges_[patch].begin, ranges_[patch].count);
  }

 private:
  struct Range {
    std::size_t begin = 0;
    int count = 0;
    bool known = false;
  };

  std::vector<Range> ranges_;  // #Q
  std::vector<SampleSpan> spans_;
  std::vector<int> missing_;
  std::vector<std::vector<SampleSpan>> found_;  // by ranges of the missing ones
  tbb::enumerable_thread_specific<TileOutlines> outlines_;

  void find_missing(const PatchScan& scan, std::span<const int> wanted);
  void find(const PatchScan& scan, std::span<const int> patches, std::vector<SampleSpan>& found);
  void append(std::span<const int> patches, std::vector<SampleSpan>& found);
};

}  // namespace quadrille
