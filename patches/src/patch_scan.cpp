#include "patch_scan.h"

#include <algorithm>
#include <numeric>

namespace quadrille {
namespace {

/// Where the outline crosses a row's centre line: in front of sample x; winding changes by `turn`
/// from there on. Rows and samples are counted from the raster's first.
struct Crossing {
  int row, x, turn;
};

/// The samples scanned: their size in fixed-point units, the first one's indices, their number.
struct ScanRaster {
  int bits;
  std::int64_t x, y;
  int columns, rows;
};

/// Walks a segment from row to row in whole numbers: the crossing in row r is in front of sample
/// ceil(((x0 - half) dy + (center_r - y0) dx) / (unit dy)).
template <class Wide, bool kDoubles>
void walk_segment(const FixedPoint& a, const FixedPoint& b, int turn, std::int64_t row_begin,
                  std::int64_t row_end, const ScanRaster& raster,
                  std::vector<Crossing>& crossings) {
  const std::int64_t unit = std::int64_t{1} << raster.bits, half = unit / 2;
  const Wide dx = b.x - a.x, dy = b.y - a.y, divisor = dy << raster.bits;
  // Quotients are rounded up; their remainders lie in (-divisor, 0].
  const auto divide = [&](Wide numerator) {
    if constexpr (kDoubles) {
      // Both are whole numbers below 2^53: the rounded quotient is never below a whole number that
      // the true one reaches nor above one that it does not.
      const double exact = static_cast<double>(numerator) / static_cast<double>(divisor);
      Wide quotient = static_cast<Wide>(exact);
      quotient += exact > static_cast<double>(quotient);
      return std::pair{quotient, numerator - quotient * divisor};
    } else {
      Wide quotient = numerator / divisor, rest = numerator % divisor;
      if (rest > 0) ++quotient, rest -= divisor;
      return std::pair{quotient, rest};
    }
  };
  auto [quotient, rest] = divide(Wide((a.x & (unit - 1)) - half) * dy +
                                 Wide((row_begin << raster.bits) + half - a.y) * dx);
  quotient += (a.x >> raster.bits) - raster.x;
  std::pair<Wide, Wide> step = {0, 0};
  if (row_end - row_begin > 1) step = divide(dx << raster.bits);
  for (std::int64_t row = row_begin; row < row_end; ++row) {
    const Wide column = std::clamp<Wide>(quotient, 0, raster.columns);
    crossings.push_back({static_cast<int>(row - raster.y), static_cast<int>(column), turn});
    quotient += step.first;
    rest += step.second;
    if (rest <= -divisor) --quotient, rest += divisor;
  }
}

/// Adds the crossings of a segment, half-open in y: a row belongs to it when y0 <= center < y1.
/// `turn` is the winding change across segments that run down.
void cross_segment(FixedPoint a, FixedPoint b, int turn, const ScanRaster& raster,
                   std::vector<Crossing>& crossings) {
  if (a.y > b.y) std::swap(a, b), turn = -turn;
  const std::int64_t row_begin = std::max(first_center(a.y, raster.bits), raster.y);
  const std::int64_t row_end = std::min(first_center(b.y, raster.bits), raster.y + raster.rows);
  if (row_begin >= row_end) return;
  constexpr std::int64_t kSmall = std::int64_t{1} << 25, kNarrow = std::int64_t{1} << 30;
  const std::int64_t size = std::max(b.y - a.y, std::abs(b.x - a.x));
  if (size < kSmall) {
    walk_segment<std::int64_t, true>(a, b, turn, row_begin, row_end, raster, crossings);
  } else if (size < kNarrow) {
    walk_segment<std::int64_t, false>(a, b, turn, row_begin, row_end, raster, crossings);
  } else {
    walk_segment<__int128, false>(a, b, turn, row_begin, row_end, raster, crossings);
  }
}

/// The ranges of one row where the winding number, summed over its crossings sorted by x, is
/// positive.
void append_row_spans(std::span<const Crossing> row, std::vector<SampleSpan>& found) {
  int winding = 0, begin = 0;
  for (std::size_t i = 0; i < row.size();) {
    const int x = row[i].x, before = winding;
    while (i < row.size() && row[i].x == x) winding += row[i++].turn;
    if (before <= 0 && winding > 0) begin = x;
    if (before > 0 && winding <= 0) found.push_back({row[0].row, begin, x});
  }
}

/// Memory that is used again from call to call.
struct Scratch {
  std::vector<Crossing> crossings, sorted;
  std::vector<int> row_begin;
};

/// Sorts the crossings by row and x; most rows have two.
void sort_crossings(Scratch& scratch, int rows) {
  scratch.row_begin.assign(rows + 2, 0);
  int* const next = scratch.row_begin.data() + 1;  // becomes each row's end while placing
  for (const Crossing& c : scratch.crossings) ++next[c.row + 1];
  for (int r = 0; r < rows; ++r) next[r + 1] += next[r];
  scratch.sorted.resize(scratch.crossings.size());
  for (const Crossing& c : scratch.crossings) {
    scratch.sorted[next[c.row]++] = c;
  }
  for (int r = 0; r < rows; ++r) {
    Crossing* const first = scratch.sorted.data() + scratch.row_begin[r];
    Crossing* const last = scratch.sorted.data() + scratch.row_begin[r + 1];
    for (Crossing* c = first; c != last; ++c) {
      for (Crossing* d = c; d != first && d->x < d[-1].x; --d) std::swap(*d, d[-1]);
    }
  }
}

std::vector<int> all_patches(const PatchMesh& patches) {
  std::vector<int> all(patches.patch_count());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

SampleWindow intersection(const SampleWindow& a, const SampleWindow& b) {
  return {std::max(a.x_begin, b.x_begin), std::max(a.y_begin, b.y_begin),
          std::min(a.x_end, b.x_end), std::min(a.y_end, b.y_end)};
}

PatchScan::PatchScan(const PatchMesh& patches) : patches_(patches) {}

PatchScan::PatchScan(const PatchMesh& patches, const SampleGrid& grid)
    : PatchScan(patches,
                Eigen::Translation2d(grid.offset.matrix()) * Eigen::Scaling(grid.scale.matrix())) {}

PatchScan::PatchScan(const PatchMesh& patches, const Eigen::Affine2d& to_samples)
    : PatchScan(patches) {
  start(to_samples);
  add(all_patches(patches), [](std::size_t count, const auto& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
  });
}

void PatchScan::start(const Eigen::Affine2d& to_samples) {
  to_samples_ = to_samples;
  orientation_ = to_samples.linear().determinant() < 0 ? -1 : 1;
  lines_.assign(patches_.mesh.edge_count(), {});
  boxes_.resize(patches_.patch_count());
  points_.clear();
}

void PatchScan::find_missing(std::span<const int> wanted) {
  missing_.clear();
  for (const int q : wanted) {
    for (int k = 0; k < 4; ++k) {
      Line& line = lines_[patches_.mesh.edge(4 * q + k)];
      if (line.count != 0) continue;
      line.count = -1;
      missing_.push_back(patches_.mesh.edge(4 * q + k));
    }
  }
}

void PatchScan::make_room() {
  std::size_t end = points_.size();
  for (const int e : missing_) {
    lines_[e].begin = end;
    end += lines_[e].count;
  }
  points_.resize(end);
}

void PatchScan::count_points(int e) {
  lines_[e].count = edge_piece_count(patches_, e, to_samples_) + 1;
}

void PatchScan::write_line(int e) {
  const Line& line = lines_[e];
  write_edge_polyline(patches_, e, to_samples_,
                      {points_.data() + line.begin, static_cast<std::size_t>(line.count)});
}

void PatchScan::bound(int patch) {
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  FixedPoint low{kFar, kFar}, high{-kFar, -kFar};
  for (int k = 0; k < 4; ++k) {
    for (const FixedPoint& p : polyline(patches_.mesh.edge(4 * patch + k))) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  boxes_[patch] = {low, high};
}

SampleWindow PatchScan::bounds(int patch) const {
  const auto [low, high] = boxes_[patch];
  const auto first = [](std::int64_t c) { return static_cast<int>(first_center(c, kFixedBits)); };
  return {first(low.x), first(low.y), first(high.x), first(high.y)};
}

SampleWindow PatchScan::touched(int patch) const {
  const auto [low, high] = boxes_[patch];
  const auto floor = [](std::int64_t c) { return static_cast<int>(c >> kFixedBits); };
  const auto ceil = [](std::int64_t c) {
    return static_cast<int>((c + kFixedOne - 1) >> kFixedBits);
  };
  return {floor(low.x), floor(low.y), ceil(high.x), ceil(high.y)};
}

void PatchScan::spans(int patch, const SampleWindow& window, int refinement,
                      std::vector<SampleSpan>& found) const {
  found.clear();
  if (window.empty()) return;
  const auto refined = [&](int n) { return std::int64_t{n} * (1 << refinement); };
  const ScanRaster raster = {kFixedBits - refinement, refined(window.x_begin),
                             refined(window.y_begin),
                             static_cast<int>(refined(window.x_end) - refined(window.x_begin)),
                             static_cast<int>(refined(window.y_end) - refined(window.y_begin))};
  thread_local Scratch scratch;
  scratch.crossings.clear();
  for (int k = 0; k < 4; ++k) {
    const int h = 4 * patch + k, e = patches_.mesh.edge(h);
    // Where an outline runs up, its patch lies on the right.
    const int turn = patches_.mesh.halfedge(e) == h ? -orientation_ : orientation_;
    const auto points = polyline(e);
    for (std::size_t i = 1; i < points.size(); ++i) {
      cross_segment(points[i - 1], points[i], turn, raster, scratch.crossings);
    }
  }
  sort_crossings(scratch, raster.rows);
  for (int r = 0; r < raster.rows; ++r) {
    append_row_spans({scratch.sorted.data() + scratch.row_begin[r],
                      scratch.sorted.data() + scratch.row_begin[r + 1]},
                     found);
  }
}

}  // namespace quadrille
