// What the options of one format do to its files.
#include <gtest/gtest.h>

#include <utility>

#include "command_line.h"

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
  const fs::path page = fresh_folder("dpi") / "page.eps";
  for (const auto& [dpi, width] : {std::pair("72", "250"), {"36", "500"}}) {
    expect_silent_success(quadrille({"export", document(), "-o", page.string(), "--dpi", dpi}));
    const auto box = std::string("%%BoundingBox: 0 0 ") + width + ' ';
    EXPECT_NE(bytes_of(page).find(box), std::string::npos) << dpi;
  }
}

}  // namespace
}  // namespace quadrille::test
