#include "density_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "quadrille/error.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// A disc and waves, alike in both halves of the picture.
Raster picture() {
  Raster result(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int in_half = x % (kWidth / 2);
      const bool disc = std::hypot(in_half - 80, y - 120) < 50;
      float* p = result.pixel(x, y);
      p[0] = disc ? 0.9f : 0.2f;
      p[1] = 0.5f;
      p[2] = 0.5f + 0.1f * std::sin(0.1f * y);
    }
  }
  return result;
}

Raster filled(int width, int height, float value) {
  Raster map(width, height, 3);
  std::fill(map.data.begin(), map.data.end(), value);
  return map;
}

/// Two pixels, the left one white.
Raster bright_left(float right) {
  Raster map = filled(2, 1, right);
  std::fill_n(map.data.begin(), 3, 1.0f);
  return map;
}

int quads_left_of(const QuadMesh& mesh, double x) {
  int count = 0;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    double centre = 0;
    for (int k = 0; k < 4; ++k) centre += mesh.vertices[mesh.quads()[q][k]].x() / 4;
    count += centre < x;
  }
  return count;
}

TEST(DensityMap, MoreQuadsWhereItIsBrighter) {
  const int wished = 1500;
  for (const float dark : {0.25f, 0.0f}) {
    const QuadMesh mesh =
        quadrangulate(picture(), {.quads = wished, .density = bright_left(dark)}).mesh;
    EXPECT_NEAR(mesh.quad_count(), wished, 0.05 * wished);
    const int left = quads_left_of(mesh, kWidth / 2.0);
    EXPECT_GT(left, 2 * (mesh.quad_count() - left)) << dark;
  }
}

TEST(DensityMap, ASmallBrightPlaceMeetsTheCount) {
  Raster map = filled(16, 12, 0.0f);
  std::fill_n(map.pixel(4, 4), 3, 1.0f);
  const QuadMesh mesh = quadrangulate(picture(), {.quads = 1500, .density = map}).mesh;
  EXPECT_NEAR(mesh.quad_count(), 1500, 75);
}

TEST(DensityMap, AConstantMapChangesNothing) {
  const QuadMesh without = quadrangulate(picture(), {.quads = 600}).mesh;
  for (const float value : {0.0f, 0.3f, 1.0f}) {
    const QuadMesh with =
        quadrangulate(picture(), {.quads = 600, .density = filled(7, 5, value)}).mesh;
    EXPECT_EQ(with.vertices, without.vertices);
    EXPECT_EQ(with.quads(), without.quads());
  }
}

TEST(DensityMap, IsTheMeanOfTheChannelsTimesAlphaWithAFloor) {
  Raster map(3, 1, 4);
  map.data = {1, 0.5f, 0, 0.5f, 1, 1, 1, 0, 1, 1, 1, 1};
  const FieldGrid<float> density = density_map(map, 3, 1);
  EXPECT_FLOAT_EQ(density(0, 0), 0.25f);
  EXPECT_FLOAT_EQ(density(1, 0), 1.0f / 64);
  EXPECT_FLOAT_EQ(density(2, 0), 1.0f);
}

TEST(DensityMap, IsStretchedToAnySize) {
  const Raster map = bright_left(0.5f);
  const FieldGrid<float> larger = density_map(map, 8, 4);
  EXPECT_FLOAT_EQ(larger(0, 3), 1.0f);
  EXPECT_FLOAT_EQ(larger(7, 0), 0.5f);
  EXPECT_FLOAT_EQ(density_map(map, 1, 1)(0, 0), 0.75f);
}

TEST(DensityMap, AMalformedMapIsRefused) {
  Raster map = bright_left(0.5f);
  map.data[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(quadrangulate(picture(), {.density = map}), Error);
}

}  // namespace
}  // namespace quadrille
