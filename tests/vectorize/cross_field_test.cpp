#include "quadrille/cross_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "grid_solver.h"

namespace quadrille {
namespace {

Raster drawn(int w, int h, const std::function<float(double, double)>& gray) {
  Raster picture(w, h, 3);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = gray(x + 0.5, y + 0.5);
    }
  }
  return picture;
}

float disc(double x, double y) {
  return static_cast<float>(1 / (1 + std::exp(std::hypot(x - 64, y - 64) - 35)));
}

TEST(GridSolver, SolvesTheEquation) {
  std::mt19937 random(1);
  for (const auto [w, h] : {std::array{1, 1}, {1, 9}, {17, 1}, {33, 20}, {64, 65}}) {
    FieldGrid<float> mass(w, h);
    ComplexGrid expected(w, h), b(w, h), x(w, h);
    for (std::size_t i = 0; i < mass.data.size(); ++i) {
      mass.data[i] = random() % 3 == 0 ? 0.5f : 0.0f;
      expected.data[i] = {float(random() % 100) / 50 - 1, float(random() % 100) / 50 - 1};
    }
    mass.data[0] = 1;
    for (int j = 0; j < h; ++j) {
      for (int i = 0; i < w; ++i) {
        b(i, j) = mass(i, j) * expected(i, j);
        for (const auto [dx, dy] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          if (i + dx < 0 || j + dy < 0 || i + dx >= w || j + dy >= h) continue;
          b(i, j) += expected(i, j) - expected(i + dx, j + dy);
        }
      }
    }
    const RunContext context;
    const int iterations = GridSolver(mass, context).solve(b, x, 1e-6, 100);
    EXPECT_LT(iterations, 30) << "independent of the size";
    for (std::size_t i = 0; i < x.data.size(); ++i) {
      EXPECT_LT(std::abs(x.data[i] - expected.data[i]), 2e-3) << w << "x" << h;
    }
  }
}

TEST(CrossField, ConstantPictureIsAxisAlignedWithoutSingularities) {
  const FeatureTensor features = feature_tensor(drawn(60, 40, [](double, double) { return 0.4f; }));
  const CrossField field = cross_field(features);
  for (const auto& z : field.z.data) EXPECT_LT(std::abs(z - std::complex<float>(1)), 1e-3);
  EXPECT_TRUE(singularities(field).empty());
  EXPECT_EQ(misalignment_degrees(field, features), 0);
}

TEST(CrossField, FollowsAnObliqueEdge) {
  const double angle = 0.5;
  const FeatureTensor features = feature_tensor(drawn(120, 120, [&](double x, double y) {
    const double d = -(x - 60) * std::sin(angle) + (y - 60) * std::cos(angle);
    return static_cast<float>(1 / (1 + std::exp(-d)));
  }));
  const CrossField field = cross_field(features, {.alignment = 0.3});
  EXPECT_NEAR(field.angle(60, 60), angle, 0.06);
}

TEST(CrossField, IndicesOfADiscInARectangleSumUpToZero) {
  // The border is axis-aligned, so the field does not turn along it: the indices cancel.
  const FeatureTensor features = feature_tensor(drawn(128, 128, disc));
  const CrossField field = cross_field(features);
  int sum = 0;
  for (const Singularity& s : singularities(field)) sum += s.quarter_index;
  EXPECT_EQ(sum, 0);
  EXPECT_FALSE(singularities(field).empty()) << "a circle cannot be followed without";
  EXPECT_LT(misalignment_degrees(field, features), 12);
}

TEST(CrossField, IndexOfAnalyticFields) {
  for (const int quarters : {-2, -1, 1, 2}) {
    CrossField field{ComplexGrid(8, 8), FieldGrid<float>(8, 8, 1)};
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        field.z(x, y) = std::polar(1.0f, float(quarters * std::atan2(y - 3.4, x - 3.7)));
      }
    }
    int sum = 0;
    for (const Singularity& s : singularities(field)) {
      sum += s.quarter_index;
      EXPECT_NEAR(s.x, 4, 1.01);
      EXPECT_NEAR(s.y, 4, 1.01);
    }
    EXPECT_EQ(sum, quarters);
  }
}

TEST(CrossField, SameBitsForAnyNumberOfThreads) {
  const FeatureTensor features = feature_tensor(drawn(300, 200, disc));
  const CrossField one = cross_field(features, {}, {.threads = 1});
  for (const int threads : {2, 3}) {
    EXPECT_EQ(cross_field(features, {}, {.threads = threads}).z.data, one.z.data);
  }
}

}  // namespace
}  // namespace quadrille
