#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "exporters/gltf_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using nlohmann::json;
using test::GltfFile;
using test::written;

VectorImage random_picture(int columns, int rows, double width, double height,
                           std::uint32_t seed = 1, double curvature = 0.6, bool opaque = true) {
  PatchMesh patches =
      testing::random_patches(columns, rows, width, height, seed, {.curvature = curvature});
  testing::set_random_colors(patches, seed + 1, opaque);
  return testing::single_layer(std::move(patches), width, height);
}

/// A constant colour over the left half of the picture.
VectorImage left_half(const Color& premultiplied) {
  PatchMesh patches = straight_patches(testing::lattice(2, 2, 7.3, 10));
  testing::set_linear_colors(patches, premultiplied);
  return testing::single_layer(std::move(patches), 15, 10);
}

/// The validator comes from npm; a developer may go without it, a continuous build may not.
std::string validator_script() {
  const std::filesystem::path folder = QUADRILLE_SOURCE_DIR "/tests/programs";
  if (!std::filesystem::exists(folder / "node_modules" / "gltf-validator")) return {};
  return (folder / "validate_gltf.mjs").string();
}

/// The triangles tile the rectangle: all face +z, their areas add up, and each edge is used once in
/// each direction, or once in all and lies on the border.
void expect_tiling(const GltfFile& file, double width, double height) {
  const auto positions = file.attribute(0, "POSITION");
  const auto indices = file.triangles(0);
  double sum = 0;
  int turned = 0, repeated = 0, open = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const auto &a = positions[indices[i]], &b = positions[indices[i + 1]],
               &c = positions[indices[i + 2]];
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    turned += area <= 0;
    sum += area;
  }
  for (const auto& [a, b] : test::open_sides(file, &repeated)) {
    const bool on_border = (a[0] == 0 && b[0] == 0) || (a[1] == 0 && b[1] == 0) ||
                           (a[0] == float(width) && b[0] == float(width)) ||
                           (a[1] == float(height) && b[1] == float(height));
    open += !on_border;
  }
  EXPECT_EQ(turned, 0);
  EXPECT_EQ(repeated, 0);
  EXPECT_EQ(open, 0);
  EXPECT_NEAR(sum, width * height, 1e-9 * width * height);
}

TEST(Gltf, TrianglesTileThePictureWhateverTheCurvature) {
  for (const double curvature : {0.0, 0.05, 0.6, 1.2}) {
    for (const std::uint32_t seed : {1, 2}) {
      for (const double size : {8.0, 64.0, 1024.0}) {
        SCOPED_TRACE(::testing::Message() << curvature << ", " << seed << ", " << size);
        const VectorImage image = random_picture(4, 3, size, size / 2, seed, curvature);
        expect_tiling(written(image, {.texels_per_pixel = 8 / size}), size, size / 2);
      }
    }
  }
}

TEST(Gltf, StraightPatchesBecomeTwoTrianglesEach) {
  const GltfFile file = written(random_picture(5, 4, 50, 40, 1, 0));
  EXPECT_EQ(file.triangles(0).size(), 3 * 2 * 20);
  EXPECT_EQ(file.attribute(0, "POSITION").size(), 6 * 5);
}

TEST(Gltf, BoundsAndTextureCoordinatesAreThePicture) {
  const GltfFile file = written(random_picture(4, 3, 48, 33));
  const int accessor = file.primitive(0)["attributes"]["POSITION"];
  const json& bounds = file.gltf["accessors"][accessor];
  EXPECT_EQ(bounds["min"], json({0.0, 0.0, 0.0}));
  EXPECT_EQ(bounds["max"], json({48.0, 33.0, 0.0}));
  const auto positions = file.attribute(0, "POSITION");
  const auto coordinates = file.attribute(0, "TEXCOORD_0");
  ASSERT_EQ(positions.size(), coordinates.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_NEAR(coordinates[i][0], positions[i][0] / 48, 1e-6);
    EXPECT_NEAR(coordinates[i][1], 1 - positions[i][1] / 33, 1e-6);
  }
}

TEST(Gltf, TheTextureIsTheRenderedPicture) {
  const VectorImage image = random_picture(4, 3, 48, 33);
  const GltfFile file = written(image, {.texels_per_pixel = 3});
  const Raster texture = file.image(0);
  EXPECT_FALSE(texture.has_alpha());
  ASSERT_EQ(texture.width, 144);
  ASSERT_EQ(texture.height, 99);
  // But for what is sharpened, and rounding to 8 bits.
  EXPECT_LE(compare(texture, render(image, {.scale = 3})).mae, 1);
}

TEST(Gltf, TexturesStayWithinTheLimitOfGraphicsProcessors) {
  const Raster texture = written(random_picture(6, 1, 5000, 3)).image(0);
  EXPECT_EQ(texture.width, 8192);
  EXPECT_EQ(texture.height, 5);
}

TEST(Gltf, MaterialsAreUnlitAndSaySo) {
  const GltfFile file = written(random_picture(1, 1, 6, 4));
  EXPECT_EQ(file.gltf["extensionsUsed"], json({"FB_ngon_encoding", "KHR_materials_unlit"}));
  const json& material = file.gltf["materials"][0];
  EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(material.value("alphaMode", "OPAQUE"), "OPAQUE");
  EXPECT_EQ(file.gltf["samplers"][0]["wrapS"], 33071);
  EXPECT_EQ(file.gltf["samplers"][0]["magFilter"], 9729);
  EXPECT_EQ(file.gltf["asset"]["extras"]["unit"], "pixel");
}

TEST(Gltf, OpaquePaintGoesOnPastItsOutline) {
  const GltfFile file = written(left_half(Color(1, 0.4f, 0, 1)));
  EXPECT_EQ(file.gltf["materials"][0].value("alphaMode", "OPAQUE"), "OPAQUE");
  const Raster texture = file.image(0);
  ASSERT_FALSE(texture.has_alpha());
  for (std::size_t i = 0; i < texture.data.size(); ++i) {
    EXPECT_NEAR(texture.data[i], (std::array{1.0, 0.4, 0.0}[i % 3]), 1 / 255.0) << i;
  }
}

TEST(Gltf, TranslucentPaintKeepsItsAlphaUpToAndPastItsOutline) {
  const GltfFile file = written(left_half(Color(0.5f, 0.2f, 0, 0.5f)));
  EXPECT_EQ(file.gltf["materials"][0]["alphaMode"], "BLEND");
  const Raster texture = file.image(0);
  ASSERT_TRUE(texture.has_alpha());
  for (std::size_t i = 0; i < texture.data.size(); ++i) {
    EXPECT_NEAR(texture.data[i], (std::array{1.0, 0.4, 0.0, 0.5}[i % 4]), 2 / 255.0) << i;
  }
}

TEST(Gltf, TransparentTexelsTakeTheColourOfTheirSurroundings) {
  // Red whose alpha falls from 1 at the left to 0 at x = 12 and stays below 0 from there on.
  PatchMesh patches = straight_patches(testing::lattice(2, 1, 16, 8));
  testing::set_linear_colors(patches, Color(1, 0, 0, 1), Color(-1, 0, 0, -1) / 12);
  const Raster texture = written(testing::single_layer(std::move(patches), 16, 8)).image(0);
  ASSERT_TRUE(texture.has_alpha());
  EXPECT_EQ(texture.pixel(31, 0)[3], 0);
  for (int x = 0; x < texture.width; ++x) EXPECT_GT(texture.pixel(x, 3)[0], 0.98) << x;
}

TEST(Gltf, PassesTheKhronosValidator) {
  const std::string script = validator_script();
  if (script.empty()) {
    ASSERT_EQ(std::getenv("CI"), nullptr) << "run `npm ci` in tests/programs";
    GTEST_SKIP() << "no glTF validator; run `npm ci` in tests/programs";
  }
  VectorImage layered = random_picture(3, 3, 30, 30);
  layered.layers.push_back(layered.layers[0]);
  layered.layers[1].transform = Eigen::Translation2d(25, 5) * Eigen::Scaling(-0.5, 0.5);
  std::vector<std::string> command = {"node", script};
  const auto add = [&](const VectorImage& image, const GltfOptions& options = {},
                       const std::string& ending = ".glb") {
    command.push_back(written(image, options, {}, ending).path.string());
  };
  add(random_picture(4, 3, 48, 33));
  add(random_picture(1, 1, 1, 1, 1, 0), {.texels_per_pixel = 1});
  add(random_picture(4, 3, 48, 33, 5, 0.6, false));
  add(left_half(Color(0.5f, 0.2f, 0, 0.5f)));
  add(layered);
  // 65536 vertices, one more than 16-bit indices reach.
  add(testing::single_layer(straight_patches(testing::lattice(255, 255, 60, 40)), 60, 40));
  const VectorImage torn = test::torn_disc(true), torn_alpha = test::torn_disc(false);
  for (const VectorImage* image : {&torn, &torn_alpha, &std::as_const(layered)}) {
    for (const auto compression :
         {GltfCompression::none, GltfCompression::quantize, GltfCompression::meshopt}) {
      add(*image, {.lit = true, .relief = 5, .compression = compression});
      add(*image, {.colors = GltfColors::vertex, .compression = compression});
      add(*image, {.texture_format = GltfTextureFormat::webp, .compression = compression}, ".gltf");
      add(*image, {.texture_format = GltfTextureFormat::jpeg, .compression = compression}, ".gltf");
    }
    add(*image, {.colors = GltfColors::vertex, .lit = true}, ".gltf");
  }
  for (const char* name : {"nothing.glb", "nothing.gltf"}) {
    const std::filesystem::path path = test::scratch_dir() / name;
    write_gltf(left_half(Color::Zero()), path);
    command.push_back(path.string());
  }
  std::string output;
  EXPECT_EQ(test::run(command, &output), 0) << output;
}

TEST(Gltf, MirroredLayersFaceTheFrontAndLieAboveTheOthers) {
  VectorImage image = random_picture(3, 3, 30, 20);
  image.layers[0].transform = Eigen::Translation2d(30, 0) * Eigen::Scaling(-1.0, 1.0);
  expect_tiling(written(image), 30, 20);
  image.layers.push_back(image.layers[0]);
  const GltfFile file = written(image);
  ASSERT_EQ(file.gltf["nodes"].size(), 2);
  EXPECT_EQ(file.gltf["nodes"][1]["translation"], json({0.0, 0.0, 1.0}));
}

TEST(Gltf, WritesTheSameBytesForAnyThreadCount) {
  const VectorImage image = random_picture(5, 4, 50, 40, 3, 0.6, false);
  RunContext context;
  context.threads = 1;
  const std::string expected = written(image, {}, context).bytes;
  for (const int threads : {2, 3}) {
    context.threads = threads;
    EXPECT_EQ(written(image, {}, context).bytes, expected);
  }
}

ErrorCode failure(const VectorImage& image, const std::filesystem::path& path, double texels) {
  try {
    write_gltf(image, path, {.texels_per_pixel = texels});
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(Gltf, RefusesWhatItCannotWrite) {
  const VectorImage image = random_picture(1, 1, 6, 4);
  const auto path = test::scratch_dir() / "refused.glb";
  EXPECT_EQ(failure(image, path, 0), ErrorCode::invalid_argument);
  EXPECT_EQ(failure(image, path, NAN), ErrorCode::invalid_argument);
  EXPECT_EQ(failure({6, 4, {}, {}}, path, 2), ErrorCode::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(failure(image, test::scratch_dir() / "absent" / "a.glb", 2), ErrorCode::io_failure);
}

}  // namespace
}  // namespace quadrille
