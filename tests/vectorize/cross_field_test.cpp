#include "quadrille/cross_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "grid_solver.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Complex = std::complex<float>;

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

struct LinearSystem {
  FieldGrid<float> mass;
  ComplexGrid solution, right_side;
};

LinearSystem random_system(int w, int h) {
  std::mt19937 random(1);
  LinearSystem system{FieldGrid<float>(w, h), ComplexGrid(w, h), ComplexGrid(w, h)};
  auto& [mass, expected, b] = system;
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
  return system;
}

double largest_error(const ComplexGrid& a, const ComplexGrid& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
  }
  return largest;
}

const std::array<std::array<int, 2>, 6> kGrids = {
    {{1, 1}, {1, 9}, {17, 1}, {33, 20}, {64, 65}, {300, 211}}};

TEST(GridSolver, SolvesTheEquation) {
  for (const auto [w, h] : kGrids) {
    const LinearSystem system = random_system(w, h);
    ComplexGrid x(w, h);
    const int iterations =
        GridSolver<Complex>(system.mass, {}).solve(system.right_side, x, 1e-6, 100);
    EXPECT_LT(iterations, 30) << "independent of the size";
    EXPECT_LT(largest_error(x, system.solution), 2e-3) << w << "x" << h;
  }
}

TEST(GridSolver, CyclesShrinkTheErrorWhateverTheSize) {
  for (const auto [w, h] : kGrids) {
    const LinearSystem system = random_system(w, h);
    const RunContext context;
    GridSolver<Complex> solver(system.mass, context);
    ComplexGrid x = solver.estimate(system.right_side);
    solver.improve(system.right_side, x, 12);
    EXPECT_LT(largest_error(x, system.solution), 2e-3) << w << "x" << h;
  }
}

TEST(GridSolver, RealNumbersAreThePartsOfComplexOnes) {
  const LinearSystem system = random_system(40, 31);
  FieldGrid<float> b(40, 31), x(40, 31);
  for (std::size_t i = 0; i < b.data.size(); ++i) b.data[i] = system.right_side.data[i].real();
  ComplexGrid z(40, 31);
  GridSolver<float>(system.mass, {}).improve(b, x, 2);
  GridSolver<Complex>(system.mass, {}).improve(system.right_side, z, 2);
  for (std::size_t i = 0; i < x.data.size(); ++i) EXPECT_EQ(x.data[i], z.data[i].real());
}

TEST(GridSolver, MassCanChange) {
  const LinearSystem system = random_system(40, 31);
  const RunContext context;
  GridSolver<Complex> solver(FieldGrid<float>(40, 31, 5), context);
  solver.set_mass(system.mass);
  ComplexGrid x(40, 31);
  solver.solve(system.right_side, x, 1e-6, 100);
  EXPECT_LT(largest_error(x, system.solution), 2e-3);
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
  EXPECT_LT(misalignment_degrees(field, features), 7);
}

TEST(CrossField, TheAllowanceTradesAlignmentForSingularities) {
  const FeatureTensor features = feature_tensor(drawn(128, 128, disc));
  const CrossField strict = cross_field(features, {.alignment = 0.05, .cancelling_allowance = 0});
  const CrossField lenient = cross_field(features, {.alignment = 0.05, .cancelling_allowance = 1});
  EXPECT_LT(singularities(lenient).size(), singularities(strict).size());
  EXPECT_GT(misalignment_degrees(lenient, features), misalignment_degrees(strict, features));
  EXPECT_LT(misalignment_degrees(lenient, features), 12) << "still followed";
}

TEST(CrossField, IndexOfAnalyticFields) {
  for (const int quarters : {-2, -1, 1, 2}) {
    CrossField field{ComplexGrid(8, 8), {}};
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

Raster noise(int w, int h) {
  std::mt19937 random(7);
  Raster picture(w, h, 3);
  for (float& value : picture.data) value = float(random() % 256) / 255;
  return picture;
}

TEST(CrossField, IndicesSumUpToZeroInEveryPhase) {
  for (const auto [w, h] : {std::array{60, 60}, {97, 41}, {3, 50}}) {
    const CrossField field = cross_field(feature_tensor(noise(w, h)), {.alignment = 0.3});
    for (const CrossFieldPhase& phase : field.phases) {
      int sum = 0;
      for (const Singularity& s : phase.singularities) sum += s.quarter_index;
      EXPECT_EQ(sum, 0) << phase.name << " " << w << "x" << h;
    }
  }
}

TEST(CrossField, PhasesLowerTheEnergyAndTheNumberOfSingularities) {
  const CrossField field = cross_field(feature_tensor(noise(150, 110)));
  ASSERT_EQ(field.phases.size(), 3u);
  EXPECT_EQ(field.phases[0].name, "smooth");
  EXPECT_EQ(field.phases[1].name, "renormalised");
  EXPECT_EQ(field.phases[2].name, "cancelled");
  for (std::size_t i = 1; i < field.phases.size(); ++i) {
    EXPECT_LE(field.phases[i].energy, field.phases[i - 1].energy) << field.phases[i].name;
    EXPECT_LE(field.phases[i].singularities.size(), field.phases[i - 1].singularities.size())
        << field.phases[i].name;
  }
  EXPECT_LT(field.phases[2].singularities.size(), field.phases[1].singularities.size());
  EXPECT_EQ(field.phases.back().singularities.size(), singularities(field).size());
}

TEST(CrossField, IsOfUnitLengthAlsoAtSingularities) {
  const FeatureTensor features = feature_tensor(drawn(128, 128, disc));
  const CrossField field = cross_field(features);
  for (const auto& z : field.z.data) EXPECT_NEAR(std::abs(z), 1, 1e-5);
  EXPECT_FALSE(singularities(field).empty());
}

TEST(CrossField, TinyPictures) {
  for (const auto [w, h] : {std::array{1, 1}, {1, 7}, {2, 2}, {5, 1}}) {
    const CrossField field = cross_field(feature_tensor(noise(w, h)));
    EXPECT_TRUE(singularities(field).empty());
    EXPECT_EQ(field.z.data.size(), std::size_t(w) * h);
  }
}

TEST(CrossField, OptionsOutOfRangeAreRefused) {
  const FeatureTensor features = feature_tensor(noise(9, 9));
  for (const CrossFieldOptions& options :
       {CrossFieldOptions{.alignment = 0}, CrossFieldOptions{.alignment = -1},
        CrossFieldOptions{.alignment = std::nan("")}, CrossFieldOptions{.alignment = 1e9},
        CrossFieldOptions{.renormalizing_rounds = -1}, CrossFieldOptions{.renormalizing_weight = 0},
        CrossFieldOptions{.cancelling_radius = -1}, CrossFieldOptions{.cancelling_radius = 100000},
        CrossFieldOptions{.cancelling_allowance = -0.1}}) {
    EXPECT_THROW(cross_field(features, options), Error);
  }
}

TEST(CrossField, SameBitsForAnyNumberOfThreads) {
  const FeatureTensor features = feature_tensor(noise(300, 200));
  const CrossField one = cross_field(features, {}, {.threads = 1});
  for (const int threads : {2, 3}) {
    const CrossField other = cross_field(features, {}, {.threads = threads});
    EXPECT_EQ(other.z.data, one.z.data);
    ASSERT_EQ(other.phases.size(), one.phases.size());
    for (std::size_t i = 0; i < one.phases.size(); ++i) {
      EXPECT_EQ(other.phases[i].energy, one.phases[i].energy);
    }
  }
}

}  // namespace
}  // namespace quadrille
