#pragma once

#include <vector>

#include "patch_scan.h"

namespace quadrille {

/// The outlines of patches in one window of samples: where each edge crosses the rows is worked out
/// once and serves both patches beside it. One for each thread.
class TileOutlines {
 public:
  /// Begins a window; the scan must stay until the next one.
  void start(const PatchScan& scan, const SampleWindow& window);

  /// The same ranges as PatchScan::spans() for this window without refinement.
  void spans(int patch, std::vector<SampleSpan>& found);

 private:
  /// Rows in which an edge runs one way: columns_[first], ... is the first sample right of it.
  struct Run {
    int row, count;
    bool down;  ///< along the edge's direction
    std::size_t first;
  };
  struct Crossed {
    unsigned tile = 0;
    int first = 0, last = 0;  ///< runs
  };
  /// A side of a simple patch: rows in ascending order without gaps.
  struct Side {
    static constexpr int kMost = 8;
    int count = 0;
    const Run* run[kMost];
    bool insert(const Run* r);
    bool gapless() const;
    int begin() const { return run[0]->row; }
    int end() const { return run[count - 1]->row + run[count - 1]->count; }
  };

  const PatchScan* scan_ = nullptr;
  SampleWindow window_;
  unsigned tile_ = 0;
  std::vector<Crossed> crossed_;  // #E
  std::vector<Run> runs_;
  std::vector<int> columns_;
  std::vector<int> left_, right_;  // #rows

  void cross(int edge);
  void add_run(const FixedPoint* top, const FixedPoint* bottom, bool down);
  static std::int64_t column_at(const FixedPoint& a, const FixedPoint& b, std::int64_t center);
  bool simple_spans(int patch, std::vector<SampleSpan>& found);
};

}  // namespace quadrille
