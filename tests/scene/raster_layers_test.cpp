#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "quadrille/error.h"
#include "quadrille/picture_layers.h"
#include "quadrille/render.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

const std::vector<float>& floats(const SceneLayer& layer, const std::string& name) {
  const auto& arrays = std::get<SceneGrid>(layer.content).arrays;
  return std::get<std::vector<float>>(std::ranges::find(arrays, name, &SceneArray::name)->values);
}

TEST(ErrorLayer, IsTheDifferencePerPixel) {
  Raster source(3, 2, 3), drawn(3, 2, 3);
  source.pixel(1, 1)[0] = 0.25f;
  drawn.pixel(1, 1)[0] = 0.5f;
  drawn.pixel(2, 0)[2] = 1;
  const SceneLayer layer = error_layer(source, drawn);
  const auto& difference = floats(layer, "difference");
  const auto& error = floats(layer, "error");
  EXPECT_FLOAT_EQ(difference[3 * 4], 63.75f);
  EXPECT_FLOAT_EQ(difference[3 * 2 + 2], 255);
  EXPECT_FLOAT_EQ(error[4], 63.75f / std::sqrt(3.0f));
  EXPECT_EQ(error[0], 0);
}

TEST(ErrorLayer, CountsAlphaAndColoursBehindItAsSeen) {
  Raster source(1, 1, 4), drawn(1, 1, 3);
  source.data = {1, 1, 1, 0.5f};
  drawn.data = {0.5f, 0.5f, 0.5f};
  const auto layer = error_layer(source, drawn);
  EXPECT_THAT(floats(layer, "difference"), ::testing::ElementsAre(0, 0, 0, 127.5f));
}

TEST(ErrorLayer, RefusesPicturesOfDifferentSizes) {
  EXPECT_THROW(error_layer(Raster(2, 1, 3), Raster(1, 2, 3)), Error);
}

TEST(PatchErrors, AreThoseOfTheirPlaces) {
  // Four patches of 4 x 4 pixels; each pixel of the k-th is off by k.
  const VectorImage image = single_layer(straight_patches(testing::lattice(2, 2, 8, 8)), 8, 8);
  Raster source(8, 8, 3), drawn(8, 8, 3);
  const QuadMesh& mesh = image.layers[0].patches.mesh;
  std::vector<float> expected;
  for (int q = 0; q < 4; ++q) {
    const Eigen::Vector2d corner = mesh.vertices[mesh.quads()[q][0]];
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        float* p = drawn.pixel(static_cast<int>(corner.x()) + x, static_cast<int>(corner.y()) + y);
        p[0] = p[1] = p[2] = static_cast<float>(q) / 255;
      }
    }
    expected.push_back(static_cast<float>(q));
  }
  const SceneLayer layer = error_layer(source, drawn);
  const auto errors = patch_errors(image, std::get<SceneGrid>(layer.content));
  EXPECT_THAT(errors, ::testing::Pointwise(::testing::FloatNear(1e-4f), expected));
}

TEST(PictureGroup, KnowsErrorsOnlyWithASource) {
  const auto image = std::make_shared<const VectorImage>(
      single_layer(straight_patches(testing::lattice(2, 2, 8, 8)), 8, 8));
  const auto names = [](const SceneGroup& group) {
    std::vector<std::string> list;
    for (const SceneLayer& layer : group.layers) list.push_back(layer.name);
    return list;
  };
  EXPECT_THAT(names(picture_group(image)),
              ::testing::ElementsAre("patches", "surface", "control-net", "patch-edges", "tears",
                                     "irregular-vertices"));
  const Raster source = render(*image);
  const SceneGroup group = picture_group(image, &source);
  EXPECT_THAT(names(group),
              ::testing::ElementsAre("picture", "error", "patches", "surface", "control-net",
                                     "patch-edges", "tears", "irregular-vertices"));
  EXPECT_EQ(std::get<ScenePatches>(group.layers[2].content).errors, std::vector<float>(4, 0.0f));
}

}  // namespace
}  // namespace quadrille
