#include "watershed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace quadrille {
namespace {

using Heights = FieldGrid<unsigned char>;

/// Rows that are all the same.
Heights valleys(const std::vector<int>& profile, int rows) {
  Heights height(static_cast<int>(profile.size()), rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < height.width; ++x) {
      height(x, y) = static_cast<unsigned char>(profile[x]);
    }
  }
  return height;
}

std::set<int> labels(const FieldGrid<int>& basin) { return {basin.data.begin(), basin.data.end()}; }

/// Marks the cells of the connected area around `seed` in which `is_in` holds; asks it of all
/// their neighbours.
template <class IsIn>
std::vector<int> area(const Heights& grid, int seed, std::vector<char>& seen, const IsIn& is_in) {
  const int w = grid.width, h = grid.height;
  std::vector<int> cells{seed};
  seen[seed] = 1;
  for (std::size_t head = 0; head < cells.size(); ++head) {
    const int i = cells[head], x = i % w, y = i / w;
    const auto visit = [&](int n) {
      if (!is_in(n) || seen[n]) return;
      seen[n] = 1;
      cells.push_back(n);
    };
    if (x > 0) visit(i - 1);
    if (x + 1 < w) visit(i + 1);
    if (y > 0) visit(i - w);
    if (y + 1 < h) visit(i + w);
  }
  return cells;
}

/// Plateaus with no lower cell beside them.
std::vector<std::vector<int>> minima(const Heights& grid) {
  std::vector<std::vector<int>> found;
  std::vector<char> seen(grid.data.size(), 0);
  for (int i = 0; i < static_cast<int>(grid.data.size()); ++i) {
    if (seen[i]) continue;
    bool is_minimum = true;
    auto plateau = area(grid, i, seen, [&](int n) {
      is_minimum = is_minimum && grid.data[n] >= grid.data[i];
      return grid.data[n] == grid.data[i];
    });
    if (is_minimum) found.push_back(std::move(plateau));
  }
  return found;
}

TEST(CatchmentBasins, TwoValleysAreTwoBasins) {
  const FieldGrid<int> basin = catchment_basins(valleys({30, 10, 0, 10, 40, 20, 0, 10, 30}, 5));
  EXPECT_EQ(labels(basin), (std::set{0, 1}));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 9; ++x) {
      if (x == 4) continue;  // the ridge
      EXPECT_EQ(basin(x, y) == basin(2, 2), x < 4) << x << ", " << y;
    }
  }
}

TEST(CatchmentBasins, FlatGroundIsOneBasin) {
  EXPECT_EQ(labels(catchment_basins(Heights(7, 3, 5))), std::set{0});
  EXPECT_EQ(labels(catchment_basins(Heights(1, 1, 255))), std::set{0});
}

TEST(CatchmentBasins, AFlatTopIsDividedInItsMiddle) {
  const FieldGrid<int> basin = catchment_basins(valleys({0, 9, 9, 9, 9, 9, 9, 0}, 3));
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(basin(x, y) == basin(0, 0), x < 4) << x;
  }
}

TEST(CatchmentBasins, EachIsConnectedAndHoldsOneMinimum) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    Heights height(1 + random() % 20, 1 + random() % 20);
    const unsigned levels = 2 + random() % 8;
    for (unsigned char& level : height.data) level = static_cast<unsigned char>(random() % levels);
    const FieldGrid<int> basin = catchment_basins(height);
    std::set<int> with_minimum;
    for (const std::vector<int>& minimum : minima(height)) {
      const int b = basin.data[minimum.front()];
      EXPECT_TRUE(with_minimum.insert(b).second);
      for (const int cell : minimum) EXPECT_EQ(basin.data[cell], b);
    }
    EXPECT_EQ(with_minimum, labels(basin));
    EXPECT_EQ(*with_minimum.rbegin() + 1, static_cast<int>(with_minimum.size()));
    std::vector<char> seen(basin.data.size(), 0);
    std::size_t areas = 0;
    for (int cell = 0; cell < static_cast<int>(seen.size()); ++cell) {
      if (seen[cell]) continue;
      ++areas;
      area(height, cell, seen, [&](int n) { return basin.data[n] == basin.data[cell]; });
    }
    EXPECT_EQ(areas, with_minimum.size());
  }
}

TEST(MergeShallowBasins, HeedsTheDepthBelowThePass) {
  const auto count = [](int left, int pass, int right, double depth) {
    const Heights height = valleys({200, left, pass, right, 200}, 3);
    return labels(merge_shallow_basins(height, catchment_basins(height), depth)).size();
  };
  EXPECT_EQ(count(0, 100, 40, 0.5), 2u);
  EXPECT_EQ(count(0, 100, 60, 0.5), 1u);
  EXPECT_EQ(count(60, 100, 0, 0.5), 1u);
  EXPECT_EQ(count(60, 100, 70, 0.5), 1u);
  EXPECT_EQ(count(0, 100, 60, 0.3), 2u);
  EXPECT_EQ(count(0, 100, 99, 0), 2u);
}

TEST(MergeShallowBasins, GoesOnFromWhatHasBeenMerged) {
  // The middle basin is shallow toward the left one only; with it, it is deep toward the right one.
  const Heights height = valleys({200, 0, 70, 50, 120, 10, 200}, 2);
  const FieldGrid<int> basin = merge_shallow_basins(height, catchment_basins(height), 0.5);
  EXPECT_EQ(basin(1, 0), basin(3, 0));
  EXPECT_NE(basin(1, 0), basin(5, 0));
}

}  // namespace
}  // namespace quadrille
