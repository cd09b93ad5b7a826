#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cancel_singularities.h"
#include "dual_path.h"

namespace quadrille {
namespace {

constexpr int kWidth = 72, kHeight = 56;

/// A field that nothing pulls at but the picture's border.
AngleField free_field() {
  AngleField field{FieldGrid<float>(kWidth, kHeight), FieldGrid<float>(kWidth, kHeight),
                   FieldGrid<float>(kWidth, kHeight, 1e-7f)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (x == 0 || y == 0 || x + 1 == kWidth || y + 1 == kHeight) field.mass(x, y) = 10;
    }
  }
  return field;
}

/// +1/4 at (plus, 28) and -1/4 at (minus, 28), between pixels.
float dipole(int x, int y, double plus, double minus) {
  const double angle =
      std::atan2(y + 0.5 - 28, x + 0.5 - plus) - std::atan2(y + 0.5 - 28, x + 0.5 - minus);
  return principal(static_cast<float>(angle / (2 * std::numbers::pi)));
}

AngleField dipole_field(double plus, double minus) {
  AngleField field = free_field();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) field.turns(x, y) = dipole(x, y, plus, minus);
  }
  return field;
}

/// A strong feature along a column between the two, which follows the dipole's own turn.
AngleField parted_dipole_field(double plus, double minus) {
  AngleField field = dipole_field(plus, minus);
  const int middle = static_cast<int>((plus + minus) / 2);
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = middle - 1; x <= middle; ++x) {
      field.target(x, y) = field.turns(x, y);
      field.mass(x, y) = 2;
    }
  }
  return field;
}

AngleField random_field(float mass) {
  std::mt19937 random(3);
  AngleField field = free_field();
  for (std::size_t i = 0; i < field.turns.data.size(); ++i) {
    if (field.mass.data[i] < 1) {
      field.turns.data[i] = principal(float(random() % 1000) / 1000);
      field.target.data[i] = principal(float(random() % 1000) / 1000);
      field.mass.data[i] = mass;
    }
  }
  return field;
}

int count(const AngleField& field, int sign) {
  int sum = 0;
  for (int y = 0; y + 1 < kHeight; ++y) {
    for (int x = 0; x + 1 < kWidth; ++x) sum += quarter_index(field.turns, x, y) * sign > 0;
  }
  return sum;
}

TEST(AngleField, PrincipalValue) {
  for (const float value : {0.0f, 0.2f, -0.4f, 0.49f}) {
    for (const int jump : {-3, 0, 1, 2}) {
      EXPECT_NEAR(principal(value + static_cast<float>(jump)), value, 1e-6);
    }
  }
}

TEST(AngleField, TurnsAreThoseOfTheComplexNumber) {
  ComplexGrid z(200, 1);
  for (int i = 0; i < 200; ++i) {
    z(i, 0) = std::polar(0.3f + 0.01f * static_cast<float>(i), 0.1f * static_cast<float>(i));
  }
  z(0, 0) = 0;
  AngleField field{FieldGrid<float>(200, 1), FieldGrid<float>(200, 1), FieldGrid<float>(200, 1)};
  set_turns(z, field, {});
  EXPECT_EQ(field.turns(0, 0), 0);
  for (int i = 1; i < 200; ++i) {
    const double expected = std::arg(z(i, 0)) / (2 * std::numbers::pi);
    EXPECT_NEAR(principal(field.turns(i, 0) - static_cast<float>(expected)), 0, 1e-6) << i;
    EXPECT_NEAR(std::abs(from_turns(field.turns(i, 0)) - z(i, 0) / std::abs(z(i, 0))), 0, 1e-5);
  }
}

TEST(AngleField, EnergyOfASingleTurnedPixel) {
  AngleField field = free_field();
  field.turns(30, 20) = 0.25f;
  field.mass(30, 20) = 2;
  const double unit = std::pow(std::numbers::pi / 2, 2) / 16;  // a quarter of a quarter turn
  EXPECT_NEAR(energy(field, RunContext{}), (4 + 2) * unit, 1e-5);
  field.turns(30, 20) = 1.25f;  // a whole quarter turn more is the same cross
  EXPECT_NEAR(energy(field, RunContext{}), (4 + 2) * unit, 1e-5);
}

TEST(AngleField, EnergyOfAWindowChangesAsTheWholeDoes) {
  AngleField field = random_field(0.2f);
  for (const Window window : {Window{0, 0, 9, 9}, {60, 40, kWidth, kHeight}, {20, 0, 29, 17}}) {
    const double whole = energy(field, RunContext{}), part = energy(field, window);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) field.turns(x, y) *= 0.7f;
    }
    EXPECT_NEAR(energy(field, window) - part, energy(field, RunContext{}) - whole, 1e-2);
  }
}

TEST(DualPath, FlatGroundIsCrossedTheShortWay) {
  const AngleField field = free_field();
  IndexGrid indices(kWidth - 1, kHeight - 1);
  indices(20, 20) = 1;
  indices(26, 17) = -1;
  DualPathFinder finder(field, indices, 16);
  for (const Plaquette from : {Plaquette{20, 20}, {26, 17}}) {
    const auto path = finder.nearest_opposite(from);
    ASSERT_TRUE(path);
    EXPECT_EQ(path->jumps.size(), 9u);
    EXPECT_EQ(indices(path->to.x, path->to.y), -indices(from.x, from.y));
  }
  indices(26, 17) = 1;
  EXPECT_FALSE(finder.nearest_opposite({20, 20})) << "none of the opposite sign";
}

TEST(DualPath, PartnersBeyondTheRadiusAreNotFound) {
  const AngleField field = free_field();
  IndexGrid indices(kWidth - 1, kHeight - 1);
  indices(10, 20) = 1;
  indices(20, 20) = -1;
  EXPECT_FALSE(DualPathFinder(field, indices, 9).nearest_opposite({10, 20}));
  EXPECT_TRUE(DualPathFinder(field, indices, 10).nearest_opposite({10, 20}));
}

TEST(WindowSolve, AJumpChangeCarriesAnIndexAcrossTheEdge) {
  // Where nothing else is, the angles go along with a changed jump as two opposite singularities.
  for (int direction = 0; direction < 4; ++direction) {
    AngleField field = dipole_field(30, 50);
    const Plaquette from{29, 27};
    ASSERT_EQ(quarter_index(field.turns, from.x, from.y), 1);
    const JumpChange jump = crossing(from, direction, 1);
    solve_window(field, {22, 20, 39, 37}, {&jump, 1}, {});
    const Plaquette to = neighbour(from, direction);
    EXPECT_EQ(quarter_index(field.turns, from.x, from.y), 0);
    EXPECT_EQ(quarter_index(field.turns, to.x, to.y), 1);
  }
}

TEST(WindowSolve, FindsTheMinimum) {
  AngleField field = dipole_field(30, 50);
  field.turns(40, 40) += 0.2f;
  const Window window{33, 33, 47, 47};
  const double before = energy(field, window);
  solve_window(field, window, {}, {});
  EXPECT_LT(energy(field, window), before);
  const double least = energy(field, window);
  for (const float step : {-0.02f, 0.02f}) {
    field.turns(40, 41) += step;
    EXPECT_GT(energy(field, window), least);
    field.turns(40, 41) -= step;
  }
}

TEST(CancelSingularities, ADipoleVanishes) {
  for (const double distance : {2, 9, 26}) {
    for (const bool swapped : {false, true}) {
      const double a = 36 - distance / 2, b = 36 + distance / 2;
      AngleField field = swapped ? dipole_field(b, a) : dipole_field(a, b);
      ASSERT_EQ(count(field, 1), 1);
      ASSERT_EQ(count(field, -1), 1);
      const auto changed = cancel_singularities(field, {}, {});
      EXPECT_EQ(count(field, 1) + count(field, -1), 0) << distance;
      EXPECT_EQ(changed(36, 28), 1);
    }
  }
}

TEST(CancelSingularities, ADipolePartedByAStrongFeatureStays) {
  AngleField field = parted_dipole_field(28, 44);
  ASSERT_EQ(count(field, 1), 1);
  cancel_singularities(field, {}, {});
  EXPECT_EQ(count(field, 1), 1);
  EXPECT_EQ(count(field, -1), 1);
}

TEST(CancelSingularities, TheAllowanceBuysSingularitiesForEnergy) {
  AngleField field = parted_dipole_field(28, 44);
  const double before = energy(field, RunContext{});
  cancel_singularities(field, {.allowance = 1000}, {});
  EXPECT_EQ(count(field, 1) + count(field, -1), 0);
  EXPECT_GT(energy(field, RunContext{}), before);
}

TEST(CancelSingularities, ASingularityOnItsOwnStays) {
  AngleField field = free_field();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      field.turns(x, y) =
          static_cast<float>(std::atan2(y - 27.5, x - 35.5) / (2 * std::numbers::pi));
      field.target(x, y) = field.turns(x, y);
    }
  }
  cancel_singularities(field, {}, {});
  EXPECT_EQ(count(field, 1), 1);
  EXPECT_EQ(count(field, -1), 0);
}

TEST(CancelSingularities, NeverRaisesTheEnergyNorTheSumOfIndices) {
  for (const float mass : {1e-6f, 0.02f, 0.3f, 3.0f}) {
    AngleField field = random_field(mass);
    const double before = energy(field, RunContext{});
    const int positive = count(field, 1), negative = count(field, -1);
    cancel_singularities(field, {}, {});
    EXPECT_LT(energy(field, RunContext{}), before);
    EXPECT_LT(count(field, 1), positive);
    EXPECT_EQ(count(field, 1) - count(field, -1), positive - negative);
  }
}

}  // namespace
}  // namespace quadrille
