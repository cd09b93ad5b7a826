#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadrille/error.h"
#include "quadrille/local_angle_smoothing.h"

namespace quadrille {
namespace {

Raster noise(int w, int h) {
  std::mt19937 random(11);
  Raster picture(w, h, 3);
  for (float& value : picture.data) value = float(random() % 256) / 255;
  return picture;
}

/// Bright above the line through the middle at this angle.
Raster oblique_edge(int side, double angle) {
  Raster picture(side, side, 3);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double d =
          -(x + 0.5 - side / 2.0) * std::sin(angle) + (y + 0.5 - side / 2.0) * std::cos(angle);
      for (int c = 0; c < 3; ++c)
        picture.pixel(x, y)[c] = static_cast<float>(1 / (1 + std::exp(-d)));
    }
  }
  return picture;
}

void expect_usable(const CrossField& field) {
  for (const auto& z : field.z.data) ASSERT_NEAR(std::abs(z), 1, 1e-4);
  ASSERT_FALSE(field.phases.empty());
  EXPECT_TRUE(std::isfinite(field.phases.back().energy));
  EXPECT_EQ(field.phases.back().singularities.size(), singularities(field).size());
}

TEST(PaperField, EndsOnNoiseWithAUsableField) {
  for (const auto [w, h] : {std::array{1, 1}, {2, 9}, {120, 90}}) {
    expect_usable(cross_field(feature_tensor(noise(w, h)), {.method = CrossFieldMethod::paper}));
  }
}

TEST(PaperField, FollowsAnEdgeThroughFlatGround) {
  const double angle = 0.4;
  const FeatureTensor features = feature_tensor(oblique_edge(60, angle));
  const CrossField field = cross_field(features, {.method = CrossFieldMethod::paper});
  expect_usable(field);
  EXPECT_NEAR(field.angle(30, 30), angle, 0.1);
}

TEST(PaperField, SameBitsForAnyNumberOfThreads) {
  const FeatureTensor features = feature_tensor(noise(260, 180));
  const CrossFieldOptions options{.method = CrossFieldMethod::paper};
  EXPECT_EQ(cross_field(features, options, {.threads = 1}).z.data,
            cross_field(features, options, {.threads = 2}).z.data);
}

TEST(LocalAngleSmoothing, FollowsFeatures) {
  const double angle = 0.4;
  const FeatureTensor features = feature_tensor(oblique_edge(120, angle));
  const CrossField field = local_angle_smoothing(features, {.alignment = 0.5});
  expect_usable(field);
  EXPECT_NEAR(field.angle(60, 60), angle, 0.06);
}

TEST(LocalAngleSmoothing, LeavesSeveralTimesTheSingularitiesWithoutAHierarchy) {
  const FeatureTensor features = feature_tensor(noise(150, 110));
  const CrossField local = local_angle_smoothing(features, {.sweeps = 60, .hierarchical = false});
  expect_usable(local);
  EXPECT_GT(singularities(local).size(), 4 * singularities(cross_field(features)).size());
}

TEST(LocalAngleSmoothing, SameBitsForAnyNumberOfThreads) {
  const FeatureTensor features = feature_tensor(noise(260, 180));
  EXPECT_EQ(local_angle_smoothing(features, {}, {.threads = 1}).z.data,
            local_angle_smoothing(features, {}, {.threads = 2}).z.data);
}

TEST(LocalAngleSmoothing, OptionsOutOfRangeAreRefused) {
  const FeatureTensor features = feature_tensor(noise(9, 9));
  EXPECT_THROW(local_angle_smoothing(features, {.alignment = 0}), Error);
  EXPECT_THROW(local_angle_smoothing(features, {.sweeps = -1}), Error);
}

}  // namespace
}  // namespace quadrille
