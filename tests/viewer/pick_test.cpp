#include "pick.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

VectorImage curved_picture() {
  PatchMesh patches = testing::random_patches(6, 5, 60, 50, 21);
  testing::set_random_colors(patches, 22);
  return single_layer(std::move(patches), 60, 50);
}

TEST(Pick, FindsThePatchAndItsParametersAnywhere) {
  const VectorImage image = curved_picture();
  testing::Random random(9);
  for (int q = 0; q < image.patch_count(); ++q) {
    const auto geometry = patch_geometry(image.layers[0].patches, q);
    for (int round = 0; round < 20; ++round) {
      const double u = random.uniform(0.01, 0.99), v = random.uniform(0.01, 0.99);
      const auto found = pick(image, geometry.at(u, v), 0);
      ASSERT_TRUE(found) << q;
      EXPECT_EQ(found->kind, Pick::Kind::patch);
      EXPECT_EQ(found->index, q);
      EXPECT_NEAR(found->u, u, 1e-6);
      EXPECT_NEAR(found->v, v, 1e-6);
    }
  }
}

TEST(Pick, FindsTheNearestVertexWithinReach) {
  const VectorImage image = curved_picture();
  const auto& vertices = image.layers[0].patches.mesh.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto found = pick(image, vertices[v] + Vector2d(0.3, -0.2), 0.5);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, Pick::Kind::vertex);
    EXPECT_EQ(found->index, static_cast<int>(v));
  }
}

TEST(Pick, FindsNothingOutside) { EXPECT_FALSE(pick(curved_picture(), {-3, 20}, 1)); }

TEST(Pick, PrefersTheLayerOnTop) {
  VectorImage image = curved_picture();
  image.layers.push_back(image.layers[0]);
  image.layers[1].transform.translate(Vector2d(2, 1)).scale(0.5);
  const Vector2d inside =
      image.layers[1].transform * patch_geometry(image.layers[1].patches, 7).at(0.5, 0.5);
  const auto found = pick(image, inside, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->layer, 1);
  EXPECT_EQ(found->index, 7);
}

TEST(Describe, NamesTheNumbersOfAPatch) {
  const VectorImage image = curved_picture();
  std::vector<float> errors(image.patch_count(), 0.0f);
  errors[4] = 12.345f;
  const std::string text = describe(image, {Pick::Kind::patch, 0, 4, 0.25, 0.5}, errors);
  for (const char* part : {"patch 4", "layer 0", "u 0.250", "scaled Jacobian", "12.35 of 255"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  EXPECT_NE(describe(image, {Pick::Kind::patch, 0, 4}, {}).find("unknown"), std::string::npos);
}

TEST(Describe, ListsTheWedgesOfAVertexOnATear) {
  testing::SplitMesh split = testing::split_mesh(4, 4, 40, 40, 20, 20);
  testing::tear(split.mesh, split.line);
  const int h = split.mesh.halfedge(split.line[1]);
  const int torn = split.mesh.tip(h);
  const VectorImage image = single_layer(straight_patches(split.mesh), 40, 40);
  const std::string text = describe(image, {Pick::Kind::vertex, 0, torn}, {});
  EXPECT_EQ(std::ranges::count(text, 'w'), 2) << text;
  EXPECT_NE(text.find("valence 4"), std::string::npos) << text;
}

TEST(PickedLayer, RunsAroundThePatch) {
  const VectorImage image = curved_picture();
  const SceneLayer layer = picked_layer(image, {Pick::Kind::patch, 0, 3}, {{}, 0.01});
  const auto geometry = patch_geometry(image.layers[0].patches, 3);
  for (const Vector2d& p : std::get<SceneShapes>(layer.content).points) {
    const auto at = parameters_at(geometry, p);
    ASSERT_TRUE(at);
    const double to_side = std::min(at->minCoeff(), 1 - at->maxCoeff());
    EXPECT_LE(to_side, 1e-6);
  }
}

}  // namespace
}  // namespace quadrille::viewer
