// The command line itself: help, version, and what is said about a wrong one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"
#include "support/programs.h"

namespace quadrille::test {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kSubCommands = {"vectorize", "export",  "render",
                                               "inspect",   "compare", "info"};

TEST(Usage, HelpNamesEverySubCommand) {
  const CommandResult help = quadrille({"help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const std::string& name : kSubCommands) EXPECT_THAT(help.out, HasSubstr(name));
  EXPECT_EQ(quadrille({"--help"}).out, help.out);
}

TEST(Usage, EverySubCommandExplainsItself) {
  for (const std::string& name : kSubCommands) {
    const CommandResult help = quadrille({"help", name});
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("quadrille " + name));
    EXPECT_EQ(quadrille({name, "--help"}).exit_code, 0) << name;
  }
  EXPECT_THAT(quadrille({"help", "vectorize"}).out, HasSubstr("--quads"));
}

TEST(Usage, VersionIsOneLine) {
  const CommandResult version = quadrille({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("quadrille [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Usage, OptionsOfTheMeshAreForPictures) {
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--quads", "100"}, {"--tears", "off"}, {"--lattice"}, {"--alignment", "0.3"}}) {
    const CommandResult result =
        quadrille(join({"render", "a.quad", "-o", (scratch_dir() / "a.png").string()}, options));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(is_one_complaint(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("a.quad"));
  }
}

TEST(Usage, WholeNumbersAreCalledSo) {
  for (const char* quads : {"abc", "1e3", "2.5", "-1", "2000001", "99999999999"}) {
    const CommandResult result = quadrille({"a.png", "-o", "b.svg", "--quads", quads});
    EXPECT_EQ(result.exit_code, 2) << quads;
    EXPECT_THAT(result.err, testing::HasSubstr("'" + std::string(quads) +
                                               "' is not a whole number from 1 to 2000000"));
  }
}

TEST(Usage, InspectTellsOfItsSceneFile) {
  EXPECT_THAT(quadrille({"help", "inspect"}).out, HasSubstr(".vtm file of all stages"));
}

class WrongUsage : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(WrongUsage, OneLineThatPointsToHelpAndExitCodeTwo) {
  const CommandResult result = quadrille(GetParam());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(is_one_complaint(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("quadrille help"));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUsage,
    testing::Values(
        std::vector<std::string>{}, std::vector<std::string>{"vectorise", "a.png"},
        std::vector<std::string>{"help", "nothing"}, std::vector<std::string>{"vectorize"},
        std::vector<std::string>{"vectorize", "a.png"},
        std::vector<std::string>{"vectorize", "a.png", "b.png", "-o", "c.svg"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--quads", "0"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--quads", "2000001"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--quads", "many"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--preset", "poster"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--alignment", "1e9"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--lattice", "--alignment", "1000.5"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--alignment", "0"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--max-error", "0"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--max-error", "256"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--scale", "0"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--scale", "-2"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--scale", "nan"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--scale", "inf"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--fit", "best"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--svg-level", "best"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--svg-size-limit", "0"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--svg-level", "inkscape",
                                 "--svg-size-limit", "100"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--svg-level", "hybrid",
                                 "--svg-size-limit", "100"},
        std::vector<std::string>{"a.png", "-o", "b.pdf", "--dpi", "0"},
        std::vector<std::string>{"a.png", "-o", "b.pdf", "--dpi", "1e12"},
        std::vector<std::string>{"a.png", "-o", "b.pdf", "--dpi", "nan"},
        std::vector<std::string>{"a.png", "-o", "b.pdf", "--pdf-tolerance", "0.4"},
        std::vector<std::string>{"a.png", "-o", "b.glb", "--gltf-relief", "nan"},
        std::vector<std::string>{"a.png", "-o", "b.svgz", "--svg-size-limit", "nan"},
        std::vector<std::string>{"a.png", "-o", "b.quad", "--max-error", "nan"},
        std::vector<std::string>{"compare", "a.png", "b.png", "--max-mae", "nan"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--threads", "-1"},
        std::vector<std::string>{"a.png", "-o", "b.png", "-v", "-q"},
        std::vector<std::string>{"a.png", "-o", "b.png", "--unknown"},
        std::vector<std::string>{"render", "a.quad", "-o", "b.png", "--region", "1,2,3"},
        std::vector<std::string>{"render", "a.quad", "-o", "b.png", "--region", "0,0,0,5"},
        std::vector<std::string>{"render", "a.quad", "-o", "b.png", "--scale", "2", "--width", "9"},
        std::vector<std::string>{"render", "a.quad", "-o", "b.png", "--bits", "12"},
        std::vector<std::string>{"inspect", "a.png", "-o", "b.png"},
        std::vector<std::string>{"inspect", "a.png", "-o", "b.vtm", "--stage", "quads"},
        std::vector<std::string>{"inspect", "a.png", "-o", "b.vtm", "--scale", "2"},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--report", ""},
        std::vector<std::string>{"a.png", "-o", "b.svg", "--density", ""},
        std::vector<std::string>{"export", "a.quad", "-o", "b.vtu", "--source", ""},
        std::vector<std::string>{"a.png", "-o", "b.glb", "--texture-ppi", "1e9"},
        std::vector<std::string>{"inspect", "a.png", "-o", "b.png", "--stage", "colour"},
        std::vector<std::string>{"compare", "a.png"}, std::vector<std::string>{"info"},
        std::vector<std::string>{"info", "a.quad", "--xml"}));

}  // namespace
}  // namespace quadrille::test
