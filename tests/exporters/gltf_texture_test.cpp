// What the textures of glTF files show, and the files around them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "exporters/gltf_file.h"
#include "gltf_sharpen.h"
#include "quadrille/error.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "sheeted_layer.h"
#include "support/programs.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using test::GltfFile;
using test::written;

/// A colour per side of a line that is torn.
VectorImage two_colors(const Color& left, const Color& right) {
  testing::SplitMesh split = testing::split_mesh(4, 4, 20, 12, 8, 13);
  testing::tear(split.mesh, split.line);
  PatchMesh patches = straight_patches(std::move(split.mesh));
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const bool is_left = QuadMesh::quad_of(h) % 4 < 2;
    patches.wedges[patches.wedge_of_corner[h]].value = is_left ? left : right;
  }
  patches.opaque = left[3] == 1 && right[3] == 1;
  return testing::single_layer(std::move(patches), 20, 12);
}

/// All texels of a texture have this straight colour, within a step of 8 bits.
void expect_plain(const Raster& texture, const Color& color) {
  double worst = 0;
  for (std::size_t i = 0; i < texture.data.size(); ++i) {
    worst = std::max(worst, std::abs(double(texture.data[i]) - color[i % texture.channels]));
  }
  EXPECT_LE(worst, 1.01 / 255);
}

TEST(GltfTexture, NoTexelMixesTheSidesOfATear) {
  const Color left(0.9f, 0.1f, 0.3f, 1), right(0, 0.7f, 1, 1);
  const GltfFile file = written(two_colors(left, right));
  ASSERT_EQ(file.gltf["images"].size(), 2);
  expect_plain(file.image(0), left);
  expect_plain(file.image(1), right);
}

TEST(GltfTexture, EachSideHasItsOwnTransparency) {
  const Color left(1, 0.5f, 0, 1), right(0.2f, 0, 0.1f, 0.4f);
  const GltfFile file = written(two_colors(left, right));
  ASSERT_EQ(file.gltf["images"].size(), 2);
  expect_plain(file.image(1), Color(0.5f, 0, 0.25f, 0.4f));
  EXPECT_EQ(file.gltf["materials"][1]["alphaMode"], "BLEND");
}

TEST(GltfTexture, TransparentPatchesAreLeftOut) {
  const GltfFile file = written(two_colors(Color(1, 0.5f, 0, 1), Color::Zero()));
  ASSERT_EQ(file.gltf["images"].size(), 1);
  EXPECT_EQ(file.gltf["materials"][0].value("alphaMode", "OPAQUE"), "OPAQUE");
  expect_plain(file.image(0), Color(1, 0.5f, 0, 1));
  for (const auto& place : file.attribute(0, "POSITION")) EXPECT_LE(place[0], 13);
}

TEST(GltfTexture, PatchesThatATearSeparatesHaveDifferentSheets) {
  for (const bool is_opaque : {true, false}) {
    const VectorImage image = test::torn_disc(is_opaque);
    const SheetedLayer layer(image.layers[0]);
    const auto& wedge = image.layers[0].patches.wedge_of_corner;
    EXPECT_EQ(layer.sheet_count(), 2);
    for (int v = 0; v < layer.mesh().vertex_count(); ++v) {
      for (const int a : layer.mesh().fan(v)) {
        for (const int b : layer.mesh().fan(v)) {
          if (wedge[a] == wedge[b]) continue;
          EXPECT_NE(layer.sheet(QuadMesh::quad_of(a)), layer.sheet(QuadMesh::quad_of(b)));
        }
      }
    }
  }
}

/// The colour of a texture, interpolated bilinearly, at texture coordinates.
std::array<double, 4> sampled(const Raster& texture, double u, double v) {
  const double x = std::clamp(u * texture.width - 0.5, 0.0, texture.width - 1.0);
  const double y = std::clamp(v * texture.height - 0.5, 0.0, texture.height - 1.0);
  const int x0 = std::min(int(x), std::max(0, texture.width - 2)), x1 = x0 + (texture.width > 1);
  const int y0 = std::min(int(y), std::max(0, texture.height - 2)), y1 = y0 + (texture.height > 1);
  std::array<double, 4> color = {0, 0, 0, 1};
  for (int c = 0; c < texture.channels; ++c) {
    const double top =
        std::lerp(double(texture.pixel(x0, y0)[c]), texture.pixel(x1, y0)[c], x - x0);
    const double low =
        std::lerp(double(texture.pixel(x0, y1)[c]), texture.pixel(x1, y1)[c], x - x0);
    color[c] = std::lerp(top, low, y - y0);
  }
  return color;
}

TEST(GltfTexture, ShowsEachPatchItsOwnColoursUpToItsCorners) {
  const VectorImage image = test::torn_disc(true);
  const SheetedLayer layer(image.layers[0]);
  const GltfFile file = written(image, {.texels_per_pixel = 8});
  std::vector<Raster> textures;
  for (int s = 0; s < layer.sheet_count(); ++s) textures.push_back(file.image(s));
  double sum = 0;
  int count = 0;
  for (int q = 0; q < layer.mesh().quad_count(); ++q) {
    const auto places = file.attribute(layer.sheet(q), "POSITION");
    const auto coordinates = file.attribute(layer.sheet(q), "TEXCOORD_0");
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d p = layer.mesh().vertices[layer.mesh().quads()[q][k]];
      const auto at = std::find_if(places.begin(), places.end(), [&](const auto& place) {
        return std::hypot(place[0] - p.x(), 32 - place[1] - p.y()) < 1e-5;
      });
      ASSERT_NE(at, places.end());
      const auto& uv = coordinates[at - places.begin()];
      const auto shown = sampled(textures[layer.sheet(q)], uv[0], uv[1]);
      const Color wished =
          layer.color(q).at(k == 1 || k == 2, k >= 2).cwiseMax(0.0f).cwiseMin(1.0f);
      for (int c = 0; c < 3; ++c) sum += std::abs(shown[c] - wished[c]), ++count;
    }
  }
  EXPECT_LE(sum / count, 4.0 / 255);
}

/// Rows of greys that are a parabola in linear light, from `low` up.
Texture parabola(int width, double low, double bend) {
  Texture texture{width, 3, 3, {}};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < width; ++x) {
      const double linear = low + bend * (x - width / 2) * (x - width / 2);
      const double srgb = 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      for (int c = 0; c < 3; ++c) {
        texture.data.push_back(static_cast<std::uint8_t>(std::lround(255 * srgb)));
      }
    }
  }
  return texture;
}

TEST(GltfTexture, SharpeningMakesUpForBilinearInterpolation) {
  // Between texels, linear interpolation of a x^2 is a / 4 too bright and at texels exact: a / 6 in
  // the mean. The Laplacian is 2 a.
  constexpr double kBend = 0.03;
  const auto linear = [](std::uint8_t value) {
    return std::pow((value / 255.0 + 0.055) / 1.055, 2.4);
  };
  double change = 0;
  int count = 0;
  for (double low = 0.05; low < 0.4; low += 0.003) {  // many, since each is rounded to 8 bits
    const Texture before = parabola(9, low, kBend);
    Texture after = before;
    sharpen_for_filtering(after);
    for (int x = 1; x < 8; ++x, ++count) {
      const std::size_t at = 3 * (9 + x);
      change += linear(before.data[at]) - linear(after.data[at]);
    }
  }
  EXPECT_NEAR(change / count, 0.1 * 2 * kBend, 3e-4);
}

TEST(GltfTexture, SharpeningLeavesPlainAreasAlone) {
  Texture texture{7, 5, 4, {}};
  for (int i = 0; i < 7 * 5; ++i) texture.data.insert(texture.data.end(), {3, 130, 255, 77});
  const Texture before = texture;
  sharpen_for_filtering(texture);
  EXPECT_EQ(texture.data, before.data);
}

TEST(GltfFiles, FormatsOfTexturesAndWhatTheyAskFor) {
  const VectorImage opaque = test::torn_disc(true), translucent = test::torn_disc(false);
  const auto type = [](const GltfFile& file) { return file.gltf["images"][0]["mimeType"]; };
  EXPECT_EQ(type(written(opaque)), "image/png");
  EXPECT_EQ(type(written(opaque, {.texture_format = GltfTextureFormat::jpeg})), "image/jpeg");
  EXPECT_EQ(type(written(translucent, {.texture_format = GltfTextureFormat::jpeg})), "image/png");
  const GltfFile webp = written(translucent, {.texture_format = GltfTextureFormat::webp});
  EXPECT_EQ(type(webp), "image/webp");
  EXPECT_EQ(webp.gltf["extensionsRequired"], nlohmann::json({"EXT_texture_webp"}));
  EXPECT_EQ(webp.gltf["textures"][0]["extensions"]["EXT_texture_webp"]["source"], 0);
  const Raster exact = written(translucent).image(0);
  EXPECT_LT(compare(webp.image(0), exact).mae, 8);
}

TEST(GltfFiles, AGltfHasItsDataBesideIt) {
  const VectorImage image = test::torn_disc(true);
  const fs::path folder = test::scratch_dir() / "files of %";
  fs::create_directories(folder);
  write_gltf(image, folder / "a b.gltf");
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"a b-texture-0.png", "a b-texture-1.png", "a b.bin",
                                             "a b.gltf"}));
  write_gltf(image, folder / "plain.gltf");
  const GltfFile file(folder / "plain.gltf"), binary = written(image);
  EXPECT_EQ(file.triangles(0), binary.triangles(0));
  EXPECT_EQ(file.image_bytes(1), binary.image_bytes(1));
}

TEST(GltfFiles, AnInterruptedWriteLeavesNothing) {
  const VectorImage image = test::torn_disc(false);
  const fs::path folder = test::scratch_dir() / "interrupted";
  fs::create_directories(folder);
  for (const char* ending : {".gltf", ".glb"}) {
    for (const double stop : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      RunContext context;
      context.on_progress = [&](const std::string&, double fraction) { return fraction < stop; };
      EXPECT_THROW(write_gltf(image, folder / (std::string("a") + ending), {}, context), Error);
      EXPECT_TRUE(fs::is_empty(folder));
    }
  }
  // A folder stands where a texture has to go.
  fs::create_directories(folder / "b-texture-1.png");
  EXPECT_THROW(write_gltf(image, folder / "b.gltf"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST(GltfFiles, RefusesPatchesThatGltfCannotPlace) {
  for (const double x : {1e8, std::numeric_limits<double>::infinity(), std::nan("")}) {
    VectorImage image = test::torn_disc(true);
    image.layers[0].patches.mesh.vertices[3].x() = x;
    const fs::path path = test::scratch_dir() / "far.glb";
    try {
      write_gltf(image, path);
      ADD_FAILURE() << "no error for " << x;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    }
    EXPECT_FALSE(fs::exists(path));
  }
}

TEST(GltfFiles, APictureThatCannotBeSeenIsAnEmptyScene) {
  PatchMesh patches = straight_patches(testing::lattice(2, 2, 8, 8));
  testing::set_linear_colors(patches, Color::Zero());
  patches.opaque = false;
  const VectorImage image = testing::single_layer(std::move(patches), 8, 8);
  const fs::path folder = test::scratch_dir();
  write_gltf(image, folder / "unseen.gltf");
  EXPECT_FALSE(fs::exists(folder / "unseen.bin"));
  std::ifstream file(folder / "unseen.gltf");
  EXPECT_EQ(nlohmann::json::parse(file)["scenes"].size(), 1);
}

}  // namespace
}  // namespace quadrille
