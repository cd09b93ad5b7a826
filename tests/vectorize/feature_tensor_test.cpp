#include "quadrille/feature_tensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

constexpr int kSide = 64;

/// The part of a pixel inside a shape given by its signed distance.
float inside(double distance) { return static_cast<float>(std::clamp(0.5 - distance, 0.0, 1.0)); }

template <class Distance>
Raster shape(const Distance& distance) {
  Raster picture(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = inside(distance(x + 0.5, y + 0.5));
    }
  }
  return picture;
}

/// A wedge that opens to the right from the middle, symmetric about the x axis.
Raster wedge(double half_angle) {
  return shape([=](double x, double y) {
    return -(x - kSide / 2.0) * std::sin(half_angle) +
           std::abs(y - kSide / 2.0) * std::cos(half_angle);
  });
}

double angle_at(const FeatureTensor& features, int x, int y) {
  return std::arg(features.direction(x, y)) / 4;
}

TEST(FeatureTensor, AlphaAloneMakesAFeature) {
  // Premultiplied black: the colours are 0 on both sides of the edge.
  Raster picture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = kSide / 2; x < kSide; ++x) picture.pixel(x, y)[3] = 1;
  }
  const FeatureTensor features = feature_tensor(picture);
  EXPECT_GT(features.weight(kSide / 2, 30), 0.9);
  EXPECT_EQ(features.weight(8, 30), 0);
  EXPECT_NEAR(angle_at(features, kSide / 2, 30), 0, 1e-3);
}

TEST(FeatureTensor, ColourEdgeOfEqualLuminance) {
  Raster picture(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) picture.pixel(x, y)[x + y < kSide ? 0 : 1] = 0.5f;
  }
  const FeatureTensor features = feature_tensor(picture);
  EXPECT_GT(features.weight(32, 32), 0.9);
  EXPECT_NEAR(std::abs(angle_at(features, 32, 32)), std::numbers::pi / 4, 1e-3);
}

TEST(FeatureTensor, BothSidesOfAThinLineAgree) {
  // Opposite gradients a pixel apart are the same axis: nothing cancels.
  const double angle = 0.3;
  for (const double width : {1.0, 2.0}) {
    const FeatureTensor features = feature_tensor(shape([=](double x, double y) {
      const double across = -(x - 32) * std::sin(angle) + (y - 32) * std::cos(angle);
      return std::abs(across) - width / 2;
    }));
    EXPECT_GT(features.weight(32, 32), 0.8) << width;
    EXPECT_NEAR(angle_at(features, 32, 32), angle, 0.05) << width;
  }
}

/// The sums of weight and of weighted direction over the 8 x 8 pixels around the wedge's tip.
struct CornerSums {
  double weight = 0;
  std::complex<double> pull;
};

CornerSums around_tip(double half_angle) {
  const FeatureTensor features = feature_tensor(wedge(half_angle));
  CornerSums sums;
  for (int y = kSide / 2 - 4; y < kSide / 2 + 4; ++y) {
    for (int x = kSide / 2 - 4; x < kSide / 2 + 4; ++x) {
      sums.weight += features.weight(x, y);
      sums.pull += std::complex<double>(features.weight(x, y) * features.direction(x, y));
    }
  }
  return sums;
}

TEST(FeatureTensor, BothEdgesOfASquareCornerAgreeThoseOfASharpOneFade) {
  const CornerSums square = around_tip(std::numbers::pi / 4);
  const CornerSums sharp = around_tip(std::numbers::pi / 8);
  EXPECT_NEAR(std::abs(std::arg(square.pull)), std::numbers::pi, 1e-3);
  EXPECT_GT(std::abs(square.pull), 0.9 * square.weight);
  EXPECT_LT(std::abs(sharp.pull), 0.5 * sharp.weight) << "its edges pull opposite ways";
  EXPECT_LT(sharp.weight, 0.6 * square.weight);
}

}  // namespace
}  // namespace quadrille
