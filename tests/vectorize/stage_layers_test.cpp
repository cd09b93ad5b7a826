#include "quadrille/stage_layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quadrille {
namespace {

Raster ring_picture() {
  Raster picture(64, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = std::hypot(x + 0.5 - 32, y + 0.5 - 24) < 14;
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = inside ? 0.9f : 0.1f;
    }
  }
  return picture;
}

std::size_t tuples(const SceneArray& array) {
  return std::visit([](const auto& values) { return values.size(); }, array.values) /
         array.components;
}

void expect_tuples(const std::vector<SceneArray>& arrays, std::size_t count) {
  for (const SceneArray& array : arrays) {
    EXPECT_EQ(tuples(array), count) << array.name;
    EXPECT_FALSE(array.meaning.empty()) << array.name;
  }
}

void expect_consistent(const SceneLayer& layer) {
  SCOPED_TRACE(layer.name);
  EXPECT_FALSE(layer.summary.empty());
  if (const auto* grid = std::get_if<SceneGrid>(&layer.content)) {
    expect_tuples(grid->arrays, static_cast<std::size_t>(grid->width) * grid->height);
    EXPECT_NEAR(grid->width * grid->pixel_width, 64, 1e-9);
    EXPECT_NEAR(grid->height * grid->pixel_height, 48, 1e-9);
  }
  if (const auto* shapes = std::get_if<SceneShapes>(&layer.content)) {
    expect_tuples(shapes->point_arrays, shapes->points.size());
    expect_tuples(shapes->cell_arrays, shapes->cell_count());
    for (const Eigen::Vector2d& p : shapes->points) {
      EXPECT_TRUE(p.allFinite());
      EXPECT_TRUE(p.x() > -32 && p.x() < 96 && p.y() > -24 && p.y() < 72);
    }
    for (const int i : shapes->cell_points) {
      EXPECT_TRUE(i >= 0 && i < static_cast<int>(shapes->points.size()));
    }
  }
}

TEST(StageLayers, AreConsistentInEveryStage) {
  VectorizeOptions options;
  options.quads = 200;
  const Quadrangulation stages = quadrangulate(ring_picture(), options);
  for (const SceneStage& stage : scene_stages()) {
    SCOPED_TRACE(stage.name);
    ASSERT_TRUE(can_show(stage, stages));
    const std::vector<SceneLayer> layers = stage.layers(stages, 0.25);
    EXPECT_FALSE(layers.empty());
    for (const SceneLayer& layer : layers) expect_consistent(layer);
  }
}

TEST(StageLayers, CrossesHaveTwoUnitAxesAtRightAngles) {
  VectorizeOptions options;
  options.quads = 200;
  const Quadrangulation stages = quadrangulate(ring_picture(), options);
  const auto stage =
      std::ranges::find(scene_stages(), std::string("cross-field"), &SceneStage::name);
  const std::vector<SceneLayer> layers = stage->layers(stages, 0.25);
  const auto& arrays = std::get<SceneShapes>(layers.front().content).point_arrays;
  const auto& u = std::get<std::vector<float>>(arrays[0].values);
  const auto& v = std::get<std::vector<float>>(arrays[1].values);
  ASSERT_GT(u.size(), 20);
  for (std::size_t i = 0; i < u.size(); i += 2) {
    EXPECT_NEAR(std::hypot(u[i], u[i + 1]), 1, 1e-6);
    EXPECT_NEAR(u[i] * v[i] + u[i + 1] * v[i + 1], 0, 1e-6);
  }
}

TEST(StageLayers, OfALatticeWithoutFieldsAreTheMeshOnly) {
  VectorizeOptions options;
  options.quads = 50;
  options.lattice = true;
  const Quadrangulation stages = quadrangulate(ring_picture(), options);
  for (const SceneStage& stage : scene_stages()) {
    EXPECT_EQ(can_show(stage, stages), !stage.needs_fields) << stage.name;
    if (!can_show(stage, stages)) continue;
    for (const SceneLayer& layer : stage.layers(stages, 1)) expect_consistent(layer);
  }
}

}  // namespace
}  // namespace quadrille
