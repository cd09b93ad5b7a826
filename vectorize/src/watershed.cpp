#include "watershed.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace quadrille {
namespace {

constexpr int kLevels = 256;

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
  // With a rim that is never entered: as high as can be, and labelled.
  const int w = height.width, h = height.height, stride = w + 2;
  std::vector<unsigned char> level_at(static_cast<std::size_t>(stride) * (h + 2), kLevels - 1);
  std::vector<int> label(level_at.size(), 0);
  const auto row_begin = [&](int y) { return static_cast<std::size_t>(stride) * (y + 1) + 1; };
  for (int y = 0; y < h; ++y) {
    std::copy_n(&height.data[static_cast<std::size_t>(w) * y], w, &level_at[row_begin(y)]);
    std::fill_n(&label[row_begin(y)], w, -1);
  }
  // Cells in ascending order, by counting.
  std::array<int, kLevels + 1> level_begin{};
  for (const unsigned char level : height.data) ++level_begin[level + 1];
  std::partial_sum(level_begin.begin(), level_begin.end(), level_begin.begin());
  std::vector<int> order(height.data.size());
  std::array<int, kLevels + 1> next = level_begin;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int i = static_cast<int>(row_begin(y)) + x;
      order[next[level_at[i]]++] = i;
    }
  }

  const auto for_neighbours = [&](int i, const auto& visit) {
    visit(i - 1), visit(i + 1), visit(i - stride), visit(i + stride);
  };
  int basins = 0;
  std::vector<int> queue;
  const auto flood = [&](int level) {
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const int from = queue[head];
      for_neighbours(from, [&](int n) {
        if (label[n] >= 0 || level_at[n] != level) return;
        label[n] = label[from];
        queue.push_back(n);
      });
    }
  };
  for (int level = 0; level < kLevels; ++level) {
    // Lower basins first reach into the new level, all at the same speed, ...
    queue.clear();
    for (int k = level_begin[level]; k < level_begin[level + 1]; ++k) {
      int from = -1;
      for_neighbours(order[k], [&](int n) {
        if (from < 0 && label[n] >= 0 && level_at[n] < level) from = n;
      });
      if (from < 0) continue;
      label[order[k]] = label[from];
      queue.push_back(order[k]);
    }
    flood(level);
    // ... and what they do not reach are new minima.
    for (int k = level_begin[level]; k < level_begin[level + 1]; ++k) {
      if (label[order[k]] >= 0) continue;
      label[order[k]] = basins++;
      queue.assign(1, order[k]);
      flood(level);
    }
  }
  FieldGrid<int> basin(w, h);
  for (int y = 0; y < h; ++y) {
    std::copy_n(&label[row_begin(y)], w, &basin.data[static_cast<std::size_t>(w) * y]);
  }
  return basin;
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
