#include "watershed.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

namespace quadrille {
namespace {

constexpr int kLevels = 256;

/// The grid with a rim that is never entered: as high as can be, and labelled.
struct RimmedGrid {
  int width, height, stride;
  std::vector<unsigned char> level_at;
  std::vector<int> label;  ///< basin of each cell, -1 for none yet

  explicit RimmedGrid(const FieldGrid<unsigned char>& heights)
      : width(heights.width),
        height(heights.height),
        stride(width + 2),
        level_at(static_cast<std::size_t>(stride) * (height + 2), kLevels - 1),
        label(level_at.size(), 0) {
    for (int y = 0; y < height; ++y) {
      std::copy_n(&heights.data[static_cast<std::size_t>(width) * y], width,
                  &level_at[row_begin(y)]);
      std::fill_n(&label[row_begin(y)], width, -1);
    }
  }

  std::size_t row_begin(int y) const { return static_cast<std::size_t>(stride) * (y + 1) + 1; }

  template <class Visit>
  void for_neighbours(int i, const Visit& visit) const {
    visit(i - 1), visit(i + 1), visit(i - stride), visit(i + stride);
  }

  FieldGrid<int> labels_without_rim() const {
    FieldGrid<int> basin(width, height);
    for (int y = 0; y < height; ++y) {
      std::copy_n(&label[row_begin(y)], width, &basin.data[static_cast<std::size_t>(width) * y]);
    }
    return basin;
  }
};

/// The cells inside the rim in ascending order, by counting, and where each level begins.
struct SortedCells {
  std::vector<int> cells;
  std::array<int, kLevels + 1> level_begin{};

  explicit SortedCells(const RimmedGrid& grid)
      : cells(static_cast<std::size_t>(grid.width) * grid.height) {
    for_each_cell(grid, [&](int i) { ++level_begin[grid.level_at[i] + 1]; });
    std::partial_sum(level_begin.begin(), level_begin.end(), level_begin.begin());
    std::array<int, kLevels + 1> next = level_begin;
    for_each_cell(grid, [&](int i) { cells[next[grid.level_at[i]]++] = i; });
  }

  std::span<const int> at_level(int level) const {
    return std::span(cells).subspan(level_begin[level],
                                    level_begin[level + 1] - level_begin[level]);
  }

 private:
  template <class Visit>
  static void for_each_cell(const RimmedGrid& grid, const Visit& visit) {
    for (int y = 0; y < grid.height; ++y) {
      const int begin = static_cast<int>(grid.row_begin(y));
      for (int i = begin; i < begin + grid.width; ++i) visit(i);
    }
  }
};

/// A place where two basins meet.
struct Pass {
  int a, b;
};

/// Calls visit(a, b, height) for all places where two basins meet.
template <class Visit>
void for_each_pass(const FieldGrid<unsigned char>& height, const FieldGrid<int>& basin,
                   const Visit& visit) {
  const std::size_t w = basin.width, h = basin.height;
  const auto meet = [&](std::size_t i, std::size_t j) {
    if (basin.data[i] == basin.data[j]) return;
    visit(basin.data[i], basin.data[j], std::max(height.data[i], height.data[j]));
  };
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      if (x + 1 < w) meet(y * w + x, y * w + x + 1);
      if (y + 1 < h) meet(y * w + x, (y + 1) * w + x);
    }
  }
}

/// The passes in ascending order, by counting, and where each level begins.
struct SortedPasses {
  std::vector<Pass> passes;
  std::array<std::size_t, kLevels + 1> level_begin{};

  SortedPasses(const FieldGrid<unsigned char>& height, const FieldGrid<int>& basin) {
    for_each_pass(height, basin, [&](int, int, int level) { ++level_begin[level + 1]; });
    std::partial_sum(level_begin.begin(), level_begin.end(), level_begin.begin());
    passes.resize(level_begin.back());
    std::array<std::size_t, kLevels + 1> next = level_begin;
    for_each_pass(height, basin, [&](int a, int b, int level) { passes[next[level]++] = {a, b}; });
  }
};

}  // namespace

FieldGrid<int> catchment_basins(const FieldGrid<unsigned char>& height) {
  RimmedGrid grid(height);
  const SortedCells sorted(grid);
  std::vector<int>& label = grid.label;
  int basins = 0;
  std::vector<int> queue;
  const auto flood = [&](int level) {
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const int from = queue[head];
      grid.for_neighbours(from, [&](int n) {
        if (label[n] >= 0 || grid.level_at[n] != level) return;
        label[n] = label[from];
        queue.push_back(n);
      });
    }
  };
  for (int level = 0; level < kLevels; ++level) {
    // Lower basins first reach into the new level, all at the same speed, ...
    queue.clear();
    for (const int cell : sorted.at_level(level)) {
      int from = -1;
      grid.for_neighbours(cell, [&](int n) {
        if (from < 0 && label[n] >= 0 && grid.level_at[n] < level) from = n;
      });
      if (from < 0) continue;
      label[cell] = label[from];
      queue.push_back(cell);
    }
    flood(level);
    // ... and what they do not reach are new minima.
    for (const int cell : sorted.at_level(level)) {
      if (label[cell] >= 0) continue;
      label[cell] = basins++;
      queue.assign(1, cell);
      flood(level);
    }
  }
  return grid.labels_without_rim();
}

FieldGrid<int> merge_shallow_basins(const FieldGrid<unsigned char>& height, FieldGrid<int> basin,
                                    double depth) {
  const int count = 1 + *std::max_element(basin.data.begin(), basin.data.end());
  std::vector<int> lowest(count, 255), parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < basin.data.size(); ++i) {
    lowest[basin.data[i]] = std::min<int>(lowest[basin.data[i]], height.data[i]);
  }
  const auto root = [&](int b) {
    while (parent[b] != b) b = parent[b] = parent[parent[b]];
    return b;
  };
  // Of the passes between two basins only the lowest can join them: basins only get deeper.
  const SortedPasses sorted(height, basin);
  for (int level = 0; level < kLevels; ++level) {
    for (std::size_t p = sorted.level_begin[level]; p < sorted.level_begin[level + 1]; ++p) {
      const int a = root(sorted.passes[p].a), b = root(sorted.passes[p].b);
      if (a == b || std::max(lowest[a], lowest[b]) < (1 - depth) * level) continue;
      const auto [kept, gone] = std::minmax(a, b);
      parent[gone] = kept;
      lowest[kept] = std::min(lowest[kept], lowest[gone]);
    }
  }
  for (int& b : basin.data) b = root(b);
  return basin;
}

}  // namespace quadrille
