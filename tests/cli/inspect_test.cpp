// What `quadrille inspect` draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "command_line.h"
#include "quadrille/image_file.h"

namespace quadrille::test {
namespace {

namespace fs = std::filesystem;

class Inspect : public testing::TestWithParam<std::string> {};

TEST_P(Inspect, DrawsTheStage) {
  const fs::path file = fresh_folder("inspect_" + GetParam()) / "stage.png";
  expect_silent_success(
      quadrille({"inspect", sample("formats/coast_progressive.jpg"), "--stage", GetParam(), "-o",
                 file.string(), "--quads", "200", "--scale", "2"}));
  const Raster drawing = load_image(file);
  EXPECT_EQ(drawing.width, 500);
  EXPECT_EQ(drawing.height, 500);
  int dark = 0;  // strokes and tints on the faded picture
  for (int y = 0; y < drawing.height; ++y) {
    for (int x = 0; x < drawing.width; ++x) {
      const float* p = drawing.pixel(x, y);
      dark += std::min({p[0], p[1], p[2]}) < 0.45f;
    }
  }
  EXPECT_GT(dark, 1000);
}

INSTANTIATE_TEST_SUITE_P(Stages, Inspect,
                         testing::Values("feature", "cross-field", "scale", "position", "quads",
                                         "patches"),
                         [](const auto& stage) {
                           std::string name = stage.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(InspectLattice, HasNoFieldsToDraw) {
  const fs::path folder = fresh_folder("inspect_lattice");
  const CommandResult result =
      quadrille({"inspect", sample("formats/coast_progressive.jpg"), "--stage", "cross-field",
                 "--lattice", "-o", (folder / "a.png").string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_complaint(result.err)) << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr("coast_progressive.jpg"));
  EXPECT_THAT(result.err, testing::HasSubstr("leave out --lattice"));
}

}  // namespace
}  // namespace quadrille::test
