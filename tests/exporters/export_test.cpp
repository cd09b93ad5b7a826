#include "quadrille/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

VectorImage picture(bool opaque) {
  PatchMesh patches = testing::random_patches(6, 4, 60, 40, 1);
  testing::set_random_colors(patches, 2, opaque);
  patches.opaque = opaque;
  return testing::single_layer(std::move(patches), 60, 40);
}

fs::path output(const std::string& name) { return test::scratch_dir() / ("export_" + name); }

TEST(Export, KnowsTheEndingsThatAreAlwaysThere) {
  for (const char* ending :
       {".quad", ".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".svg", ".svgz"}) {
    EXPECT_THAT(export_endings(), Contains(ending));
  }
}

TEST(Export, EveryEndingMakesAFile) {
  for (const bool opaque : {true, false}) {
    for (const std::string& ending : export_endings()) {
      const fs::path path = output("every" + ending);
      export_image(picture(opaque), path);
      EXPECT_GT(fs::file_size(path), 0u) << ending;
      fs::remove(path);
      fs::remove_all(output("every_files"));  // the tiles of .dzi
      fs::remove_all(output("every_vtm"));    // the pieces of .vtm
      fs::remove(output("every.bin"));        // what lies beside .gltf
      fs::remove(output("every-texture-0.png"));
    }
  }
}

TEST(Export, TheCaseOfTheEndingDoesNotMatter) {
  export_image(picture(true), output("case.QUAD"));
  EXPECT_EQ(load_document(output("case.QUAD")).width, 60);
}

TEST(Export, AnUnknownEndingNamesThoseThatWork) {
  for (const char* name : {"unknown.bmp", "none", "folder.png/none"}) {
    try {
      export_image(picture(true), output(name));
      FAIL() << name << " was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unsupported_format);
      EXPECT_THAT(error.what(), HasSubstr(".quad, .png, .jpg"));
      EXPECT_FALSE(fs::exists(output(name)));
    }
  }
}

TEST(Export, RasterFilesShowTheRendering) {
  for (const bool opaque : {true, false}) {
    const VectorImage image = picture(opaque);
    ExportOptions options;
    options.raster.scale = 2.5;
    options.raster.bits = 16;
    export_image(image, output("scale.png"), options);
    RenderOptions render_options;
    render_options.scale = 2.5;
    const Raster expected = render(image, render_options);
    const Raster loaded = load_image(output("scale.png"));
    ASSERT_EQ(loaded.width, 150);
    ASSERT_EQ(loaded.height, 100);
    ASSERT_EQ(loaded.channels, expected.channels);
    for (std::size_t i = 0; i < loaded.data.size(); ++i) {
      ASSERT_NEAR(loaded.data[i], expected.data[i], 0.51 / 65535);
    }
  }
}

TEST(Export, TheWidthDecidesTheSize) {
  ExportOptions options;
  options.raster.width = 33;
  export_image(picture(true), output("width.png"), options);
  EXPECT_EQ(load_image(output("width.png")).width, 33);
  EXPECT_EQ(load_image(output("width.png")).height, 22);
}

TEST(Export, CancellingLeavesNoFile) {
  RunContext context;
  context.on_progress = [](const std::string&, double) { return false; };
  EXPECT_THROW(export_image(picture(true), output("cancelled.png"), {}, context), Error);
  EXPECT_FALSE(fs::exists(output("cancelled.png")));
}

}  // namespace
}  // namespace quadrille
