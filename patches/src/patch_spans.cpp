#include "patch_spans.h"

namespace quadrille {

void PatchSpans::find_missing(const PatchScan& scan, std::span<const int> wanted) {
  // Of larger ones mostly a part is seen.
  constexpr int kLargest = 1024;
  missing_.clear();
  for (const int q : wanted) {
    if (ranges_[q].known) continue;
    const SampleWindow b = scan.bounds(q);
    const auto narrow = [](int begin, int end) { return std::int64_t{end} - begin <= kLargest; };
    if (narrow(b.x_begin, b.x_end) && narrow(b.y_begin, b.y_end)) missing_.push_back(q);
  }
}

/// Each patch's spans, and after them one with their number as its row.
void PatchSpans::find(const PatchScan& scan, std::span<const int> patches,
                      std::vector<SampleSpan>& found) {
  SampleWindow all = scan.bounds(patches[0]);
  for (const int q : patches) {
    const SampleWindow b = scan.bounds(q);
    all = {std::min(all.x_begin, b.x_begin), std::min(all.y_begin, b.y_begin),
           std::max(all.x_end, b.x_end), std::max(all.y_end, b.y_end)};
  }
  TileOutlines& outlines = outlines_.local();
  outlines.start(scan, all);
  thread_local std::vector<SampleSpan> spans;
  found.clear();
  for (const int q : patches) {
    outlines.spans(q, spans);
    for (const SampleSpan& s : spans) {
      found.push_back({s.y + all.y_begin, s.x_begin + all.x_begin, s.x_end + all.x_begin});
    }
    found.push_back({static_cast<int>(spans.size()), 0, 0});
  }
}

void PatchSpans::append(std::span<const int> patches, std::vector<SampleSpan>& found) {
  // From the last one, whose number of spans stands behind it.
  std::size_t end = found.size();
  for (auto q = patches.rbegin(); q != patches.rend(); ++q) {
    const int count = found[--end].y;
    end -= count;
    ranges_[*q] = {spans_.size(), count, true};
    spans_.insert(spans_.end(), found.begin() + end, found.begin() + end + count);
  }
}

}  // namespace quadrille
