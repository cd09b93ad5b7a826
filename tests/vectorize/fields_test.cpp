#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
  return {FieldGrid<std::complex<float>>(w, h, std::polar(1.0f, float(4 * angle))),
          FieldGrid<float>(w, h, 1)};
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

TEST(ScaleField, UniformWithoutFeaturesAndDividesTheSides) {
  const ScaleField scale = scale_field(flat_features(96, 64), uniform_field(96, 64, 0), 24);
  for (const float l : scale.along_x.data) EXPECT_NEAR(l, 16, 1e-3);
  for (const float l : scale.along_y.data) EXPECT_NEAR(l, 16, 1e-3);
}

TEST(ScaleField, MeetsTheCountGradientAndRatioWithFeatures) {
  FeatureTensor features = flat_features(200, 160);
  for (int y = 20; y < 140; ++y) features.edges(70, y) = 1;
  const ScaleOptions options;
  const ScaleField scale = scale_field(features, uniform_field(200, 160, 0.3), 100, options);
  EXPECT_NEAR(cells(scale), 100, 8) << "whole cells across may change it a little";
  float smallest = 1e9f, largest = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x + 1 < 200; ++x) {
      const float a = scale.along_x(x, y), b = scale.along_x(x + 1, y);
      EXPECT_LE(std::abs(a - b), 1.5 * options.max_gradient);
      smallest = std::min(smallest, a), largest = std::max(largest, a);
    }
  }
  EXPECT_LE(largest / smallest, 1.01 / options.min_ratio);
  EXPECT_EQ(std::min_element(scale.along_x.data.begin(), scale.along_x.data.end()) -
                    scale.along_x.data.begin() >=
                70,
            true);
  EXPECT_LT(scale.along_x(70, 80), scale.along_x(180, 80));
}

TEST(PositionField, ExactLatticeOnAConstantPicture) {
  const int w = 96, h = 64;
  const FeatureTensor features = flat_features(w, h);
  const CrossField field = uniform_field(w, h, 0);
  const ScaleField scale = scale_field(features, field, 24);
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
  const ScaleField scale = scale_field(features, field, 20);
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
