#include "watershed.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace quadrille {
namespace {

/// The lowest way between two basins.
struct Pass {
  std::uint64_t basins;  ///< both, the lower number in the upper half
  unsigned char height;
};

std::vector<Pass> lowest_passes(const FieldGrid<unsigned char>& height,
                                const FieldGrid<int>& basin) {
  std::vector<Pass> passes;
  const auto meet = [&](std::size_t i, std::size_t j) {
    const auto [a, b] = std::minmax(basin.data[i], basin.data[j]);
    if (a == b) return;
    passes.push_back({(static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint64_t>(b),
                      std::max(height.data[i], height.data[j])});
  };
  const std::size_t w = basin.width, h = basin.height;
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      if (x + 1 < w) meet(y * w + x, y * w + x + 1);
      if (y + 1 < h) meet(y * w + x, (y + 1) * w + x);
    }
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) {
    return a.basins != b.basins ? a.basins < b.basins : a.height < b.height;
  });
  passes.erase(std::unique(passes.begin(), passes.end(),
                           [](const Pass& a, const Pass& b) { return a.basins == b.basins; }),
               passes.end());
  std::stable_sort(passes.begin(), passes.end(),
                   [](const Pass& a, const Pass& b) { return a.height < b.height; });
  return passes;
}

}  // namespace

FieldGrid<int> catchment_basins(const FieldGrid<unsigned char>& height) {
  constexpr int kLevels = 256;
  const int w = height.width, h = height.height;
  const int count = w * h;
  // Cells in ascending order, by counting.
  std::array<int, kLevels + 1> level_begin{};
  for (const unsigned char level : height.data) ++level_begin[level + 1];
  for (int l = 0; l < kLevels; ++l) level_begin[l + 1] += level_begin[l];
  std::vector<int> order(count);
  std::array<int, kLevels + 1> next = level_begin;
  for (int i = 0; i < count; ++i) order[next[height.data[i]]++] = i;

  FieldGrid<int> basin(w, h, -1);
  std::vector<int>& label = basin.data;
  const auto for_neighbours = [&](int i, const auto& visit) {
    const int x = i % w;
    if (x > 0) visit(i - 1);
    if (x + 1 < w) visit(i + 1);
    if (i >= w) visit(i - w);
    if (i + w < count) visit(i + w);
  };
  int basins = 0;
  std::vector<int> queue;
  const auto flood = [&](int level) {
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const int from = queue[head];
      for_neighbours(from, [&](int n) {
        if (label[n] >= 0 || height.data[n] != level) return;
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
        if (from < 0 && label[n] >= 0 && height.data[n] < level) from = n;
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
  for (const Pass& pass : lowest_passes(height, basin)) {
    const int a = root(static_cast<int>(pass.basins >> 32));
    const int b = root(static_cast<int>(pass.basins & 0xffffffffu));
    if (a == b || std::max(lowest[a], lowest[b]) < (1 - depth) * pass.height) continue;
    const auto [kept, gone] = std::minmax(a, b);
    parent[gone] = kept;
    lowest[kept] = std::min(lowest[kept], lowest[gone]);
  }
  for (int& b : basin.data) b = root(b);
  return basin;
}

}  // namespace quadrille
