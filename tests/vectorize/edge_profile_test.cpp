#include "edge_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "box_filtered.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using test::box_filtered, test::kBright, test::kDark;

constexpr double kOffsetTolerance = 0.02;  // pixels, of an edge along the grid
// Interpolation between pixels that lie askew lets an oblique edge undulate.
constexpr double kJitter = 0.15, kMeanTolerance = 0.03;  // pixels
const double kJump = (kBright - kDark).norm();

Vector2d direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

TEST(EdgeProfile, FindsAStepAtAnyPlaceInAPixel) {
  for (double t = 0; t < 1; t += 0.0625) {
    const Raster picture =
        box_filtered(24, 4, kDark, kBright, [&](double x, double) { return x > 12 + t ? 1 : 0; });
    const EdgeProfile profile = edge_profile(PremultipliedColours(picture), {12.5, 2}, {1, 0});
    EXPECT_NEAR(12.5 + profile.offset, 12 + t, kOffsetTolerance);
    EXPECT_NEAR(profile.contrast, kJump, 0.01 * kJump);
    // A pixel off one side the mixed pixel still shows through the interpolation, by t (1/2 - t).
    const double s = std::min(t, 1 - t);
    EXPECT_NEAR(profile.sharpness, 1 - s * (0.5 - s), 0.02);
  }
}

TEST(EdgeProfile, FindsAStepOfAnySlopeInTwoSteps) {
  for (double degrees = 0; degrees < 180; degrees += 7.5) {
    const Vector2d normal = direction(degrees), along(-normal.y(), normal.x());
    const Vector2d on_edge(16.3, 15.9);
    const Raster picture = box_filtered(32, 32, kDark, kBright, [&](double x, double y) {
      return (Vector2d(x, y) - on_edge).dot(normal) > 0 ? 1 : 0;
    });
    const PremultipliedColours colours(picture);
    for (const double away : {-0.7, -0.25, 0.0, 0.3, 0.6}) {
      double mean = 0;
      constexpr int kPlaces = 64;
      for (int i = 0; i < kPlaces; ++i) {
        const Vector2d edge = on_edge + (8.0 * i / kPlaces - 4) * along;
        const Vector2d start = edge + away * normal;
        const EdgeProfile first = edge_profile(colours, start, normal);
        EXPECT_NEAR(first.offset, -away, kJitter) << degrees << " degrees";
        const Vector2d near = start + first.offset * normal;
        const EdgeProfile second = edge_profile(colours, near, normal);
        const double left = (near + second.offset * normal - edge).dot(normal);
        EXPECT_NEAR(left, 0, kJitter) << degrees << " degrees";
        EXPECT_NEAR(second.contrast, kJump, 0.01 * kJump);
        EXPECT_GT(second.sharpness, 0.86) << degrees << " degrees";
        mean += left / kPlaces;
      }
      EXPECT_NEAR(mean, 0, kMeanTolerance) << degrees << " degrees";
    }
  }
}

TEST(EdgeProfile, AStrokeBetweenTwoColoursHasTwoEdges) {
  constexpr int kFrom = 12, kTo = 14;
  Raster picture = box_filtered(24, 4, kDark, kBright, [](double x, double) { return x > kTo; });
  const Eigen::Vector3d grey(0.5, 0.5, 0.5);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < kFrom; ++x)
      Eigen::Map<Eigen::Vector3f>(picture.pixel(x, y)) = grey.cast<float>();
  }
  const EdgeProfile profile = edge_profile(PremultipliedColours(picture), {kFrom + 0.2, 2}, {1, 0});
  EXPECT_NEAR(profile.offset, -0.2, kOffsetTolerance);
  EXPECT_NEAR(profile.contrast, (kDark - grey).norm(), 0.01);
  EXPECT_GT(profile.sharpness, 0.95);
}

TEST(EdgeProfile, ARampHasTheShareOfItsSlope) {
  const Raster picture =
      box_filtered(24, 4, kDark, kBright, [](double x, double) { return x / 24; });
  const EdgeProfile profile = edge_profile(PremultipliedColours(picture), {12.2, 2}, {1, 0});
  // One pixel of the 2.5 on either side.
  EXPECT_NEAR(profile.sharpness, 0.4, 1e-3);
  EXPECT_NEAR(profile.contrast, 5.0 / 24 * kJump, 1e-3);
  EXPECT_NEAR(profile.offset, 0, 1e-3);
}

TEST(EdgeProfile, FlatGroundHasNoContrast) {
  const Raster picture = box_filtered(8, 8, kDark, kDark, [](double, double) { return 0; });
  const EdgeProfile profile = edge_profile(PremultipliedColours(picture), {4, 4}, {0, 1});
  EXPECT_EQ(profile.contrast, 0);
  EXPECT_EQ(profile.offset, 0);
  EXPECT_EQ(profile.sharpness, 0);
}

TEST(EdgeProfile, AThinLineHasTwoEdges) {
  for (const double t : {0.0, 0.25, 0.5}) {
    const Raster picture = box_filtered(
        24, 4, kDark, kBright, [&](double x, double) { return x > 11 + t && x < 13 + t ? 1 : 0; });
    const PremultipliedColours colours(picture);
    const EdgeProfile left = edge_profile(colours, {11 + t, 2}, {1, 0});
    const EdgeProfile right = edge_profile(colours, {13 + t, 2}, {1, 0});
    EXPECT_NEAR(left.offset, 0, 0.1) << t;
    EXPECT_NEAR(right.offset, 0, 0.1) << t;
    EXPECT_GT(left.contrast, 0.85 * kJump) << t;
    EXPECT_GT(right.contrast, 0.85 * kJump) << t;
    EXPECT_GT(left.sharpness, 0.86) << t;
  }
}

TEST(EdgeProfile, AlphaCountsAsAColour) {
  Raster picture(12, 4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 6; x < 12; ++x) picture.pixel(x, y)[3] = 1;  // black
  }
  const EdgeProfile profile = edge_profile(PremultipliedColours(picture), {5.8, 2}, {1, 0});
  EXPECT_NEAR(profile.contrast, 1, 1e-6);
  EXPECT_NEAR(profile.offset, 0.2, kOffsetTolerance);
}

}  // namespace
}  // namespace quadrille
