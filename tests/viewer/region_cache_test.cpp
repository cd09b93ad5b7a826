#include "region_cache.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"

namespace quadrille::viewer {
namespace {

/// Writes every pixel's place, and counts how often pixels are drawn.
struct Places {
  long long drawn = 0;

  RegionCache::Draw draw() {
    return [this](const PixelRegion& region, std::uint8_t* pixels, std::ptrdiff_t row_bytes) {
      for (int y = 0; y < region.height; ++y) {
        for (int x = 0; x < region.width; ++x, ++drawn) {
          std::uint8_t* p = pixels + y * row_bytes + 4 * x;
          p[0] = static_cast<std::uint8_t>(region.x + x);
          p[1] = static_cast<std::uint8_t>(region.y + y);
          p[2] = p[3] = 7;
        }
      }
    };
  }
};

long long area(const PixelRegion& r) { return static_cast<long long>(r.width) * r.height; }

TEST(RegionCache, HoldsTheRightPixelsWhereverTheViewMoves) {
  testing::Random random(5);
  RegionCache cache;
  Places places;
  for (int round = 0; round < 200; ++round) {
    const PixelRegion needed = {random.integer(10, 150), random.integer(10, 150),
                                random.integer(1, 60), random.integer(1, 60)};
    const PixelRegion wished = {needed.x - 10, needed.y - 10, needed.width + 20,
                                needed.height + 20};
    cache.cover(needed, wished, places.draw());
    ASSERT_TRUE(contains(cache.region(), needed));
    const PixelRegion& held = cache.region();
    for (int y = 0; y < held.height; ++y) {
      for (int x = 0; x < held.width; ++x) {
        const std::uint8_t* p = &cache.pixels()[4 * (y * held.width + x)];
        ASSERT_EQ(p[0], held.x + x);
        ASSERT_EQ(p[1], held.y + y);
      }
    }
  }
}

TEST(RegionCache, DrawsOnlyWhatItLacks) {
  RegionCache cache;
  Places places;
  EXPECT_TRUE(cache.cover({20, 20, 40, 40}, {10, 10, 60, 60}, places.draw()));
  EXPECT_EQ(places.drawn, 3600);
  EXPECT_FALSE(cache.cover({10, 10, 60, 60}, {0, 0, 100, 100}, places.draw()));
  EXPECT_EQ(places.drawn, 3600);
  EXPECT_TRUE(cache.cover({30, 20, 50, 40}, {20, 10, 60, 60}, places.draw()));
  EXPECT_EQ(places.drawn, 3600 + 600);
  cache.clear();
  EXPECT_TRUE(cache.cover({30, 20, 50, 40}, {20, 10, 60, 60}, places.draw()));
  EXPECT_EQ(places.drawn, 3600 + 600 + 3600);
}

TEST(Difference, IsTheWholeWithoutTheHole) {
  const PixelRegion whole = {0, 0, 20, 10};
  for (const PixelRegion& hole :
       {PixelRegion{5, 3, 4, 4}, {0, 0, 20, 10}, {0, 0, 3, 10}, {12, 4, 8, 6}, {}}) {
    long long sum = 0;
    for (const PixelRegion& part : difference(whole, hole)) {
      EXPECT_TRUE(contains(whole, part));
      EXPECT_EQ(area(intersection(part, hole)), 0);
      sum += area(part);
    }
    EXPECT_EQ(sum, area(whole) - area(hole));
  }
}

}  // namespace
}  // namespace quadrille::viewer
