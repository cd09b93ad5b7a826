// What `info` prints, and the encodings it tells of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "quadrille/document.h"
#include "quadrille/export.h"

namespace quadrille::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

json info_of(const fs::path& document) {
  const CommandResult result = quadrille({"info", document.string(), "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return json::parse(result.out);
}

TEST(Info, TellsWhatADocumentHoldsInBothEncodings) {
  const fs::path folder = fresh_folder("info");
  const fs::path small = folder / "small.quad", large = folder / "large.quad";
  const std::string picture = sample("formats/coast_progressive.jpg");
  EXPECT_EQ(quadrille({picture, "-o", small.string(), "--quads", "200"}).exit_code, 0);
  EXPECT_EQ(quadrille({picture, "-o", large.string(), "--quads", "200", "--lossless"}).exit_code,
            0);

  const VectorImage image = load_document(small);
  const json a = info_of(small), b = info_of(large);
  EXPECT_EQ(a["bytes"], fs::file_size(small));
  EXPECT_EQ(a["version"], 2);
  EXPECT_EQ(b["version"], 1);
  EXPECT_EQ(a["layers"][0]["encoding"], "quantized");
  EXPECT_EQ(b["layers"][0]["encoding"], "lossless");
  EXPECT_LT(10 * a["bytes"].get<int>(), b["bytes"].get<int>());
  EXPECT_DOUBLE_EQ(a["bytes_per_patch"],
                   static_cast<double>(fs::file_size(small)) / image.patch_count());
  for (const json& j : {a, b}) {
    EXPECT_EQ(j["width"], 250);
    EXPECT_EQ(j["opaque"], true);
    EXPECT_EQ(j["patches"], image.patch_count());
    EXPECT_EQ(j["vertices"], image.layers[0].patches.mesh.vertex_count());
    EXPECT_EQ(j["wedges"], j["vertices"]);
    EXPECT_EQ(j["tears"]["edges"], 0);
    EXPECT_EQ(j["bounding_box"], json({0, 0, image.width, image.height}));
    EXPECT_EQ(j["metadata"]["source"], "coast_progressive.jpg");
  }
}

TEST(Info, CountsTearsAndMeasuresThemInThePicture) {
  // Two quads side by side, torn apart along their common edge of 4 pixels, drawn twice as large.
  QuadMesh mesh({{0, 0}, {3, 0}, {6, 0}, {0, 4}, {3, 4}, {6, 4}}, {{0, 1, 4, 3}, {1, 2, 5, 4}});
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_border(e)) mesh.edge_flags[e] = kTearEdge;
  }
  VectorImage image;
  image.width = 20;
  image.height = 10;
  image.layers.resize(1);
  image.layers[0].name = "two\nlines";
  image.layers[0].transform.scale(2);
  image.layers[0].patches = straight_patches(std::move(mesh));
  const fs::path file = fresh_folder("info_tears") / "torn.quad";
  save_document(image, file);

  const json info = info_of(file);
  EXPECT_EQ(info["wedges"], 8);
  EXPECT_EQ(info["tears"], json({{"edges", 1}, {"length", 8.0}}));
  EXPECT_EQ(info["bounding_box"], json({0, 0, 12, 8}));
  EXPECT_EQ(info["opaque"], false);
  EXPECT_GT(info["layers"][0]["position_bits"], 0);

  const CommandResult text = quadrille({"info", file.string()});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, HasSubstr("2 patches, 6 vertices, 8 wedges, 1 tear edge of 8.0 pixels"));
  EXPECT_THAT(text.out, HasSubstr("two\\nlines"));
}

TEST(Info, CountsThePiecesOfASceneThatCanBeReached) {
  if (std::ranges::count(export_endings(), ".vtm") == 0) GTEST_SKIP() << "without VTK";
  const fs::path folder = fresh_folder("info_scene"), scene = folder / "a.vtm";
  expect_silent_success(quadrille({sample("formats/uniform_gray.png"), "-o", scene.string()}));
  std::uintmax_t bytes = fs::file_size(scene);
  for (const auto& piece : fs::directory_iterator(folder / "a_vtm")) bytes += piece.file_size();
  EXPECT_EQ(info_of(scene)["bytes"], bytes);
  fs::create_symlink("loop", folder / "a_vtm" / "loop");
  EXPECT_EQ(info_of(scene)["bytes"], bytes);
}

TEST(Info, AQuantizedDocumentExportsToItself) {
  const fs::path folder = fresh_folder("info_again");
  const fs::path first = folder / "a.quad", again = folder / "b.quad";
  quadrille({sample("pictures/flower_256_alpha.png"), "-o", first.string(), "--quads", "200"});
  EXPECT_EQ(quadrille({"export", first.string(), "-o", again.string()}).exit_code, 0);
  EXPECT_TRUE(bytes_of(first) == bytes_of(again));
}

}  // namespace
}  // namespace quadrille::test
