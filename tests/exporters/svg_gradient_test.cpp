#include "svg_gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "svg_ridge.h"

namespace quadrille {
namespace {

constexpr double kSide = 20;
const Eigen::AlignedBox2d kBounds{Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(kSide)};

/// Samples all over a square, whose colours a function of the place says.
template <class Paint>
CellSamples samples_of(const Paint& paint) {
  constexpr int n = CellSamples::kMostAlong;
  CellSamples samples;
  samples.count = n * n;
  for (int i = 0; i < n * n; ++i) {
    const Eigen::Vector2d p = Eigen::Vector2d(i % n, i / n) * (kSide / (n - 1));
    samples.position[i] = p;
    samples.color[i] = paint(p);
    samples.weight[i] = kSide * kSide / samples.count;
    samples.slopes(0, 0) += samples.weight[i];
  }
  return samples;
}

Eigen::Array3d gray(double value) { return Eigen::Array3d::Constant(value); }

/// A kink at three fifths of the way.
CellSamples kinked() {
  return samples_of(
      [](const Eigen::Vector2d& p) { return gray(40 + 9 * std::min(p.x(), 0.6 * kSide)); });
}

RidgeSystem six_stops(const CellSamples& samples) {
  return {WeightedColors(samples), common_axis(samples, kBounds, 0), 6};
}

TEST(ThinnedRidge, LeavesOutStopsBetweenKinks) {
  const auto thin = thinned_ridge(six_stops(kinked()), 1);
  EXPECT_EQ(thin.left_out.to_string(), "00010110");  // the last stop first
  EXPECT_NEAR(thin.stops(0, 0), 40, 0.1);
  EXPECT_NEAR(thin.stops(3, 0), 40 + 9 * 0.6 * kSide, 0.1);
  EXPECT_NEAR(thin.stops(5, 0), 40 + 9 * 0.6 * kSide, 0.1);
}

TEST(ThinnedRidge, KeepsAllThatAreWorthMore) {
  const CellSamples zigzag = samples_of([](const Eigen::Vector2d& p) {
    const double x = 5 * p.x() / kSide;
    return gray(100 + 80 * std::abs(std::remainder(x, 2)));
  });
  const auto thin = thinned_ridge(six_stops(zigzag), 1);
  EXPECT_TRUE(thin.left_out.none());
  EXPECT_NEAR(thin.explained, solve_ridge(six_stops(zigzag)).explained, 1e-6 * thin.explained);
}

TEST(ThinnedRidge, LeavesTheOthersAtTheirBest) {
  // Five even stops without every other are three even ones, which can be solved for as such.
  const CellSamples bent = samples_of([](const Eigen::Vector2d& p) {
    const double x = p.x() / kSide;
    const double kink = 100 * std::abs(x - 0.5);
    return Eigen::Array3d(kink + 60 * x * x, 90 - kink, 10 + 100 * x);
  });
  const RidgeAxis axis = common_axis(bent, kBounds, 0);
  const WeightedColors colors(bent);
  const auto three = solve_ridge({colors, axis, 3});
  const RidgeSystem five(colors, axis, 5);
  const double loss = solve_ridge(five).explained - three.explained;
  const auto thin = thinned_ridge(five, loss);
  ASSERT_EQ(thin.left_out.to_string(), "00001010");
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(thin.stops.row(2 * k).isApprox(three.stops.row(k), 0.01)) << k;
  }
}

TEST(ThinnedRidges, KeepBothEndsOfBothAxes) {
  const CellSamples sum = samples_of([](const Eigen::Vector2d& p) {
    return gray(30 + 4 * p.x() + 5 * std::max(0.0, p.y() - 10));
  });
  const WeightedColors colors(sum);
  const RidgeSystem across(colors, common_axis(sum, kBounds, 0), 4);
  const RidgeSystem down(colors, common_axis(sum, kBounds, kCommonDirections / 2), 3);
  const auto thin = thinned_ridges(colors, across, down, 1);
  EXPECT_EQ(thin.left_out.count(), 2u);
  EXPECT_TRUE(thin.left_out[1] && thin.left_out[2]);
  EXPECT_NEAR(thin.stops(3, 0) - thin.stops(0, 0), 4 * kSide, 0.1);
  EXPECT_NEAR(thin.stops(6, 0) - thin.stops(5, 0), 50, 0.1);
}

TEST(CellFit, HasStopsOnlyWhereColoursBend) {
  const CellFit fit = fit_cell(kinked(), kBounds, 0.01, 10);
  EXPECT_EQ(fit.fill.overlay_opacity, 0);
  const LinearGradient& base = fit.fill.base;
  EXPECT_LE(base.stop_count, 4);
  EXPECT_EQ(base.stops[0].offset, 0);
  EXPECT_EQ(base.stops[base.stop_count - 1].offset, 1);
  for (int k = 1; k < base.stop_count; ++k) {
    EXPECT_GT(base.stops[k].offset, base.stops[k - 1].offset);
  }
  EXPECT_LT(fit.squared_error, 0.5 * kSide * kSide);
}

TEST(CellFit, LaysNoSecondGradientOverEdgesThatShow) {
  // Red rises to the right, and green downward: no single gradient shows both.
  CellSamples crossed = samples_of(
      [](const Eigen::Vector2d& p) { return Eigen::Array3d(60 + 6 * p.x(), 60 + 6 * p.y(), 120); });
  EXPECT_GT(fit_cell(crossed, kBounds, 0.01, 10).fill.overlay_opacity, 0);
  crossed.is_cut = true;
  EXPECT_EQ(fit_cell(crossed, kBounds, 0.01, 10).fill.overlay_opacity, 0);
}

}  // namespace
}  // namespace quadrille
