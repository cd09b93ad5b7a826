#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "quadrille/error.h"
#include "quadrille/position_field.h"
#include "quadrille/scale_field.h"
#include "quadrille/working_picture.h"

namespace quadrille {
namespace {

FeatureTensor flat_features(int w, int h) {
  return {FieldGrid<std::complex<float>>(w, h), FieldGrid<float>(w, h),
          FieldGrid<Eigen::Vector2f>(w, h, Eigen::Vector2f::Zero()),
          FieldGrid<unsigned char>(w, h)};
}

CrossField uniform_field(int w, int h, double angle) {
  return {FieldGrid<std::complex<float>>(w, h, std::polar(1.0f, float(4 * angle))), {}};
}

double cells(const ScaleField& scale) {
  double sum = 0;
  for (std::size_t i = 0; i < scale.along_x.data.size(); ++i) {
    sum += 1.0 / (double(scale.along_x.data[i]) * scale.along_y.data[i]);
  }
  return sum;
}

TEST(WorkingPicture, CoversThePictureAndKeepsAConstant) {
  for (const double edge : {2.0, 7.0, 16.0, 50.0, 200.0}) {
    Raster picture(37, 21, 3);
    std::fill(picture.data.begin(), picture.data.end(), 0.25f);
    const WorkingPicture working = make_working_picture(picture, edge);
    EXPECT_NEAR(working.picture.width * working.scale_x, 37, 1e-9);
    EXPECT_NEAR(working.picture.height * working.scale_y, 21, 1e-9);
    for (const float v : working.picture.data) EXPECT_NEAR(v, 0.25f, 1e-6);
  }
}

ScaleField scale_for(const FeatureTensor& features, const CrossField& field, double count) {
  const double edge = std::sqrt(field.z.data.size() / count);
  return scaled_to_count(relative_scale(features, field, edge), field, count);
}

TEST(ScaleField, UniformWithoutFeaturesAndDividesTheSides) {
  const ScaleField scale = scale_for(flat_features(96, 64), uniform_field(96, 64, 0), 24);
  for (const float l : scale.along_x.data) EXPECT_NEAR(l, 16, 1e-3);
  for (const float l : scale.along_y.data) EXPECT_NEAR(l, 16, 1e-3);
}

TEST(ScaleField, CellsAreThinAcrossAFeatureAndNotShorterAlongIt) {
  FeatureTensor features = flat_features(200, 160);
  for (int y = 0; y < 160; ++y) features.gradient(70, y) = {0.3f, 0};
  const ScaleField scale = scale_for(features, uniform_field(200, 160, 0), 100);
  EXPECT_NEAR(cells(scale), 100, 12) << "whole cells across may change it a little";
  EXPECT_LT(scale.along_x(70, 80), 0.6 * scale.along_x(180, 80));
  EXPECT_LT(scale.along_x(70, 80), 0.5 * scale.along_y(70, 80));
  EXPECT_GT(scale.along_y(70, 80), 0.7 * scale.along_y(180, 80)) << "the bound on the ratio acts";
}

TEST(ScaleField, KeepsToItsBounds) {
  FeatureTensor features = flat_features(150, 150);
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 150; ++x) features.gradient(x, y) = {(x * 37 + y * 11) % 90 == 0, 0};
  }
  const ScaleOptions options;
  const CrossField field = uniform_field(150, 150, 0.3);
  const ScaleField scale = relative_scale(features, field, 12, options);
  for (std::size_t i = 0; i < scale.along_x.data.size(); ++i) {
    const float x = scale.along_x.data[i], y = scale.along_y.data[i];
    EXPECT_LE(std::max(x, y) / std::min(x, y), options.max_anisotropy * 1.01);
    EXPECT_LE(std::max(x, y), options.max_ratio * 1.01);
    EXPECT_GE(std::min(x, y), options.min_ratio * 0.99);
  }
}

// Polar lattices: the cross turns with the angle around a far point, so lines through that point
// draw apart with the distance r from it, and only lengths proportional to r belong to one lattice.
TEST(ScaleField, LengthsFollowTheTurningOfTheCross) {
  const int size = 90;
  const Eigen::Vector2d pole(-200, size / 2.0);
  CrossField field = uniform_field(size, size, 0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Eigen::Vector2d p = Eigen::Vector2d(x + 0.5, y + 0.5) - pole;
      field.z(x, y) = std::polar(1.0f, static_cast<float>(4 * std::atan2(p.y(), p.x())));
    }
  }
  ScaleOptions options;
  options.reach = 20;
  const ScaleField scale = relative_scale(flat_features(size, size), field, 10, options);
  const double grown = scale.along_y(70, 45) / scale.along_y(20, 45);
  EXPECT_NEAR(grown, (200 + 70.5) / (200 + 20.5), 0.03);
  EXPECT_NEAR(scale.along_x(70, 45) / scale.along_x(20, 45), 1, 0.03);
}

TEST(ScaleField, DensityMapMultiplies) {
  const FeatureTensor features = flat_features(120, 80);
  const CrossField field = uniform_field(120, 80, 0);
  ScaleOptions options;
  options.density = FieldGrid<float>(120, 80, 1);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 60; ++x) options.density(x, y) = 4;
  }
  const ScaleField scale = relative_scale(features, field, 4, options);
  EXPECT_NEAR(scale.along_x(110, 40) / scale.along_x(10, 40), 2, 0.1);
  EXPECT_NEAR(scale.along_y(110, 40) / scale.along_y(10, 40), 2, 0.1);
}

TEST(ScaleField, RefusesOptionsOutOfRange) {
  const FeatureTensor features = flat_features(20, 20);
  const CrossField field = uniform_field(20, 20, 0);
  for (const auto& spoil : std::vector<std::function<void(ScaleOptions&)>>{
           [](auto& o) { o.grading = -1; }, [](auto& o) { o.flat_share = 0; },
           [](auto& o) { o.min_ratio = 0; }, [](auto& o) { o.max_ratio = 0.5; },
           [](auto& o) { o.max_anisotropy = 0.5; }, [](auto& o) { o.reach = std::nan(""); },
           [](auto& o) { o.density = FieldGrid<float>(3, 3, 1); },
           [](auto& o) { o.density = FieldGrid<float>(20, 20, 0); }}) {
    ScaleOptions options;
    spoil(options);
    EXPECT_THROW(relative_scale(features, field, 5, options), Error);
  }
}

TEST(PositionField, ExactLatticeOnAConstantPicture) {
  const int w = 96, h = 64;
  const FeatureTensor features = flat_features(w, h);
  const CrossField field = uniform_field(w, h, 0);
  const ScaleField scale = scale_for(features, field, 24);
  const PositionField positions = position_field(features, field, scale);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const Eigen::Vector2f o = positions.origin(x, y);
      EXPECT_NEAR(o.x(), 16 * std::round(o.x() / 16), 0.05);
      EXPECT_NEAR(o.y(), 16 * std::round(o.y() / 16), 0.05);
      EXPECT_LE((o - Eigen::Vector2f(x + 0.5f, y + 0.5f)).cwiseAbs().maxCoeff(), 8.1f);
    }
  }
}

TEST(PositionField, ShiftBetweenLatticePointsWhateverTheNameOfTheAxes) {
  for (const double turn : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    const double angle = 0.2 + turn * std::numbers::pi / 2;
    const CrossField field = uniform_field(2, 1, angle);
    const ScaleField scale{FieldGrid<float>(2, 1, 10), FieldGrid<float>(2, 1, 10)};
    PositionField positions{FieldGrid<Eigen::Vector2f>(2, 1, Eigen::Vector2f::Zero())};
    const double axis = field.angle(0, 0);
    positions.origin(1, 0) = {float(10 * std::cos(axis) - 20 * std::sin(axis)),
                              float(10 * std::sin(axis) + 20 * std::cos(axis))};
    EXPECT_EQ(lattice_shift(field, scale, positions, 0, 0, 1, 0), Eigen::Vector2i(1, 2));
    EXPECT_EQ(lattice_shift(field, scale, positions, 1, 0, 0, 0), Eigen::Vector2i(-1, -2));
  }
}

TEST(PositionField, BorderPixelsHoldOnToTheBorder) {
  const int w = 70, h = 50;
  const FeatureTensor features = flat_features(w, h);
  const CrossField field = uniform_field(w, h, 0.4);
  const ScaleField scale = scale_for(features, field, 20);
  const PositionField positions = position_field(features, field, scale);
  for (int x = 0; x < w; ++x) {
    EXPECT_EQ(positions.origin(x, 0).y(), 0);
    EXPECT_EQ(positions.origin(x, h - 1).y(), h);
  }
  for (int y = 0; y < h; ++y) {
    EXPECT_EQ(positions.origin(0, y).x(), 0);
    EXPECT_EQ(positions.origin(w - 1, y).x(), w);
  }
}

}  // namespace
}  // namespace quadrille
