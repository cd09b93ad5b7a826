#include "quadrille/alpha_outline.h"

#include <gtest/gtest.h>

#include <numbers>

#include "vectorize/alpha_pictures.h"

namespace quadrille {
namespace {

using testing::disc;
using testing::masked_picture;

double total_area(const std::vector<Loop>& outline) {
  double area = 0;
  for (const Loop& loop : outline) area += signed_area(loop);
  return area;
}

TEST(AlphaOutline, FrameOfAnOpaquePicture) {
  for (const int channels : {3, 4}) {
    Raster picture(7, 5, channels);
    std::fill(picture.data.begin(), picture.data.end(), 1.0f);
    const auto outline = alpha_outline(picture);
    ASSERT_EQ(outline.size(), 1u);
    EXPECT_EQ(signed_area(outline[0]), 35);
    EXPECT_TRUE(is_frame(outline, 7, 5));
  }
}

TEST(AlphaOutline, NothingOfATransparentPicture) {
  EXPECT_TRUE(alpha_outline(Raster(4, 4, 4)).empty());
}

TEST(AlphaOutline, CrossesHalfWayBetweenPixelsAndRunsAlongTheFrame) {
  Raster picture(6, 4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 3; ++x) picture.pixel(x, y)[3] = 1;
  }
  const auto outline = alpha_outline(picture);
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_EQ(signed_area(outline[0]), 3 * 4);
  for (const auto& p : outline[0]) {
    EXPECT_TRUE(p.x() == 0 || p.x() == 3 || p.y() == 0 || p.y() == 4);
  }
}

TEST(AlphaOutline, FollowsADiscWithinASixthOfAPixel) {
  const double r = 20;
  const auto outline = alpha_outline(masked_picture(50, 50, disc(25, 24, r)));
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_NEAR(signed_area(outline[0]), std::numbers::pi * r * r, 0.05 * 2 * std::numbers::pi * r);
  for (const auto& p : outline[0]) EXPECT_NEAR((p - Eigen::Vector2d(25, 24)).norm(), r, 0.15);
}

TEST(AlphaOutline, RingIsTwoLoopsOfOppositeSense) {
  const auto outline = alpha_outline(masked_picture(50, 50, testing::ring(25, 25, 8, 20)));
  ASSERT_EQ(outline.size(), 2u);
  EXPECT_GT(signed_area(outline[0]), 0);
  EXPECT_LT(signed_area(outline[1]), 0);
}

TEST(AlphaOutline, LoopsOfAnyAlphaAreSimpleDisjointAndNested) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const int w = 1 + random() % 40, h = 1 + random() % 40;
    const Raster picture = testing::random_mask(random, w, h);
    const auto outline = alpha_outline(picture);
    EXPECT_TRUE(conflicts(outline).empty()) << i;
    EXPECT_TRUE(is_nested(outline)) << i;
    for (const Loop& loop : outline) {
      for (const auto& p : loop) {
        EXPECT_TRUE(p.x() >= 0 && p.x() <= w && p.y() >= 0 && p.y() <= h);
        EXPECT_EQ(p * 64, (p * 64).array().round().matrix());
      }
    }
    // Every pixel centre lies on its side.
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        int winding = 0;
        for (const Loop& loop : outline) winding += winding_number(loop, {x + 0.5, y + 0.5});
        EXPECT_EQ(winding, picture.pixel(x, y)[3] >= 0.5f);
      }
    }
  }
}

TEST(AlphaOutline, SmallLoopsAreLeftOutButNeverTheLargest) {
  Raster picture = masked_picture(60, 60, disc(30, 30, 20));
  picture.pixel(30, 30)[3] = 0;  // a pinhole
  picture.pixel(2, 2)[3] = 1;    // a speck
  EXPECT_EQ(alpha_outline(picture).size(), 3u);
  EXPECT_EQ(alpha_outline(picture, 4).size(), 1u);
  EXPECT_EQ(alpha_outline(picture, 1e9).size(), 1u);
  EXPECT_GT(total_area(alpha_outline(picture, 1e9)), 1000);
}

TEST(AlphaOutline, DiagonalPixelsJoinByTheMeanOfTheirAlpha) {
  Raster picture(4, 4, 4);
  picture.pixel(1, 1)[3] = picture.pixel(2, 2)[3] = 1;
  EXPECT_EQ(alpha_outline(picture).size(), 1u);
  picture.pixel(2, 2)[3] = 0.9f;
  EXPECT_EQ(alpha_outline(picture).size(), 2u);
}

}  // namespace
}  // namespace quadrille
