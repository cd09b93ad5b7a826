// What the options of one format do to its files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "command_line.h"
#include "quadrille/export.h"

namespace quadrille::test {
namespace {

namespace fs = std::filesystem;

class ExportOption : public testing::Test {
 protected:
  /// A document of a picture, made once.
  static const std::string& document() {
    static const std::string path = [] {
      const fs::path file = fresh_folder("document_for_options") / "coast.quad";
      expect_silent_success(quadrille(
          {sample("formats/coast_progressive.jpg"), "-o", file.string(), "--quads", "200"}));
      return file.string();
    }();
    return path;
  }
};

TEST_F(ExportOption, SvgLevelsDifferInSizeAndKeepALimit) {
  const fs::path folder = fresh_folder("svg_levels");
  const auto size_of = [&](const std::string& name, const std::vector<std::string>& options) {
    const fs::path file = folder / name;
    expect_silent_success(quadrille(join({"export", document(), "-o", file.string()}, options)));
    return fs::file_size(file);
  };
  const auto compact = size_of("compact.svg", {"--svg-level", "compact"});
  const auto balanced = size_of("balanced.svg", {});
  const auto faithful = size_of("faithful.svg", {"--svg-level", "faithful"});
  EXPECT_LT(compact, balanced);
  EXPECT_LT(balanced, faithful);
  const auto limit = (compact + balanced) / 2 / 1000;
  const auto limited = size_of("limited.svg", {"--svg-size-limit", std::to_string(limit)});
  EXPECT_LE(limited, limit * 1000);
  EXPECT_GT(limited, compact / 2);
  EXPECT_LT(size_of("compressed.svgz", {}), balanced / 2);
  size_of("meshes.svg", {"--svg-level", "inkscape"});
  EXPECT_NE(bytes_of(folder / "meshes.svg").find("<meshgradient"), std::string::npos);
}

TEST_F(ExportOption, DpiSetsThePageSize) {
  if (std::ranges::count(export_endings(), ".eps") == 0) GTEST_SKIP() << "without PDF";
  const fs::path page = fresh_folder("dpi") / "page.eps";
  for (const auto& [dpi, width] : {std::pair("72", "250"), {"36", "500"}}) {
    expect_silent_success(quadrille({"export", document(), "-o", page.string(), "--dpi", dpi}));
    const auto box = std::string("%%BoundingBox: 0 0 ") + width + ' ';
    EXPECT_NE(bytes_of(page).find(box), std::string::npos) << dpi;
  }
}

TEST_F(ExportOption, GltfFilesFollowTheirOptions) {
  const auto endings = export_endings();
  if (std::find(endings.begin(), endings.end(), ".gltf") == endings.end()) {
    GTEST_SKIP() << "built without glTF";
  }
  const fs::path folder = fresh_folder("gltf");
  const fs::path file = folder / "a.gltf";
  const auto text_with = [&](const std::vector<std::string>& options) {
    expect_silent_success(quadrille(join({"export", document(), "-o", file.string()}, options)));
    return bytes_of(file);
  };
  using testing::HasSubstr;
  using testing::Not;
  EXPECT_THAT(text_with({"--texture-format", "jpeg", "--texture-ppi", "0.5"}),
              HasSubstr("a-texture-0.jpg"));
  EXPECT_THAT(text_with({"--gltf-colors", "vertex"}),
              testing::AllOf(HasSubstr("COLOR_0"), Not(HasSubstr("images"))));
  EXPECT_THAT(text_with({"--gltf-lit"}),
              testing::AllOf(HasSubstr("NORMAL"), Not(HasSubstr("KHR_materials_unlit"))));
  EXPECT_THAT(text_with({"--gltf-compress", "meshopt", "--gltf-relief", "-9"}),
              HasSubstr("EXT_meshopt_compression"));
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--texture-format", "gif"},
                                                {"--texture-ppi", "0"},
                                                {"--texture-quality", "101"},
                                                {"--gltf-relief", "inf"},
                                                {"--gltf-compress", "zip"}}) {
    const auto result =
        quadrille(join({"export", document(), "-o", (folder / "b.gltf").string()}, wrong));
    EXPECT_EQ(result.exit_code, 2) << wrong[0];
    EXPECT_TRUE(is_one_complaint(result.err)) << result.err;
  }
  EXPECT_FALSE(fs::exists(folder / "b.gltf"));
}

}  // namespace
}  // namespace quadrille::test
