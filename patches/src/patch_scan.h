#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "edge_polyline.h"
#include "patch_inverse.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A grid of sample points over a patch mesh: the mesh point p lies at p * scale + offset in sample
/// units, and sample (i, j) has its centre at (i + 0.5, j + 0.5) there.
struct SampleGrid {
  Eigen::Array2d scale = {1, 1};
  Eigen::Array2d offset = {0, 0};
};

/// Half-open range of samples.
struct SampleWindow {
  int x_begin = 0, y_begin = 0, x_end = 0, y_end = 0;
  bool empty() const { return x_begin >= x_end || y_begin >= y_end; }
  bool operator==(const SampleWindow&) const = default;
};

/// The part that both windows cover; empty when there is none.
SampleWindow intersection(const SampleWindow& a, const SampleWindow& b);

/// Samples x_begin <= x < x_end of row y.
struct SampleSpan {
  int y, x_begin, x_end;
};

/// Scan conversion of patch outlines with an exact coverage rule. Each mesh edge is evaluated once,
/// at dyadic parameters, and put on a global fixed-point grid; the two patches beside it use the
/// same integers, so every sample inside a fold-free mesh belongs to exactly one patch whatever the
/// window. A sample lies in a patch when its centre does; a centre on an edge belongs to the patch
/// on its right or, on a horizontal edge, below.
class PatchScan {
 public:
  /// Evaluates all edges; grid must give |coordinates| < 2^31 samples, see write_edge_polyline for
  /// the errors. Keeps a reference to the patches.
  PatchScan(const PatchMesh& patches, const SampleGrid& grid);
  /// The same for any affine map from mesh coordinates to samples.
  PatchScan(const PatchMesh& patches, const Eigen::Affine2d& to_samples);
  /// Evaluates nothing yet: start() and add() must follow.
  explicit PatchScan(const PatchMesh& patches);

  /// Forgets all edges and sets the map.
  void start(const Eigen::Affine2d& to_samples);
  /// Evaluates those edges of the patches `wanted` that are missing; patches can be scanned once
  /// they were wanted. `for_each(count, body)` calls body(0) ... body(count - 1).
  template <class ForEach>
  void add(std::span<const int> wanted, const ForEach& for_each) {
    constexpr std::size_t kRange = 512;
    const auto in_ranges = [&](std::span<const int> numbers, const auto& body) {
      for_each((numbers.size() + kRange - 1) / kRange, [&](std::size_t r) {
        const std::size_t end = std::min(numbers.size(), (r + 1) * kRange);
        for (std::size_t i = r * kRange; i < end; ++i) body(numbers[i]);
      });
    };
    find_missing(wanted);
    in_ranges(missing_, [&](int e) { count_points(e); });
    make_room();
    in_ranges(missing_, [&](int e) { write_line(e); });
    in_ranges(wanted, [&](int q) { bound(q); });
  }
  std::size_t point_count() const { return points_.size(); }

  const PatchMesh& patches() const { return patches_; }

  /// Smallest window of samples that the patch's outline may cover (not clipped to anything).
  SampleWindow bounds(int patch) const;
  /// Smallest window of samples whose squares [i, i + 1] x [j, j + 1] the outline may touch.
  SampleWindow touched(int patch) const;

  /// Calls row(y, x_begin, x_end) for the samples of the window that the patch covers (winding
  /// number of its outline > 0), rows in ascending order and ranges of a row from left to right.
  template <class Row>
  void scan(int patch, const SampleWindow& window, Row&& row) const {
    std::vector<SampleSpan> found;
    spans(patch, window, 0, found);
    for (const SampleSpan& s : found) {
      row(window.y_begin + s.y, window.x_begin + s.x_begin, window.x_begin + s.x_end);
    }
  }

  /// The same ranges as a list that replaces `found`, relative to the window's first sample, with
  /// every sample divided into 2^refinement x 2^refinement (0 <= refinement <= 8).
  void spans(int patch, const SampleWindow& window, int refinement,
             std::vector<SampleSpan>& found) const;

  /// The edge as it is scanned, from the origin to the tip of its half-edge.
  std::span<const FixedPoint> polyline(int edge) const {
    const Line& line = lines_[edge];
    return {points_.data() + line.begin, static_cast<std::size_t>(line.count)};
  }

  /// Turning direction of outlines after the map: 1, or -1 when it mirrors.
  int orientation() const { return orientation_; }

 private:
  struct Line {
    std::size_t begin = 0;
    int count = 0;  ///< of points; 0 where not evaluated
  };

  const PatchMesh& patches_;
  Eigen::Affine2d to_samples_ = Eigen::Affine2d::Identity();
  int orientation_ = 1;
  std::vector<Line> lines_;  // #E
  std::vector<FixedPoint> points_;
  std::vector<std::array<FixedPoint, 2>> boxes_;  // #Q; corners of the outlines' bounding boxes
  std::vector<int> missing_;                      // edges

  void find_missing(std::span<const int> wanted);
  void count_points(int e);
  void make_room();
  void write_line(int e);
  void bound(int patch);
};

}  // namespace quadrille
