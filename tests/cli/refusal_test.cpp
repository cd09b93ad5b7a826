// Files that cannot be read or written: one line on stderr, exit code 1, nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "quadrille/export.h"
#include "support/programs.h"

namespace quadrille::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

void expect_refused(const CommandResult& result, const std::string& word) {
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(is_one_complaint(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr(word));
}

TEST(Refusal, BadPicturesGetTheirVerdict) {
  std::ifstream file(sample("manifest.json"));
  const nlohmann::json manifest = nlohmann::json::parse(file);
  for (const auto& entry : manifest.at("files")) {
    const std::string name = entry["file"];
    if (!name.starts_with("bad/")) continue;
    const fs::path folder = fresh_folder("bad");
    const CommandResult result = quadrille(
        {"vectorize", sample(name), "-o", (folder / "out.svg").string(), "--quads", "20"});
    if (entry["expect"] != "error" && result.exit_code == 0) {  // the manifest allows either
      EXPECT_EQ(result.err, "") << name;
      continue;
    }
    SCOPED_TRACE(name);
    expect_refused(result, fs::path(name).filename().string());
    EXPECT_THAT(files_in(folder), IsEmpty());
  }
}

TEST(Refusal, OpaqueRegionOfATransparentPicture) {
  const fs::path folder = fresh_folder("transparent");
  const std::string picture = sample("formats/fully_transparent.png");
  const std::string output = (folder / "a.png").string();
  expect_refused(quadrille({picture, "--mesh", "opaque", "-o", output}), "fully_transparent.png");
  expect_refused(
      quadrille({"inspect", picture, "--stage", "quads", "--mesh", "opaque", "-o", output}),
      "fully_transparent.png");
  EXPECT_THAT(files_in(folder), IsEmpty());
}

TEST(Refusal, AFullDiskLeavesNothingBehind) {
  const fs::path source = fresh_folder("full_disk_source") / "coast.quad";
  expect_silent_success(quadrille(
      {sample("formats/coast_progressive.jpg"), "-o", source.string(), "--quads", "200"}));
  for (const char* name : {"a.tif", "a.png", "a.dzi"}) {
    const fs::path folder = fresh_folder("full_disk");
    const CommandResult result = quadrille_on_full_disk(
        2, {"render", source.string(), "-o", (folder / name).string(), "--scale", "4"});
    expect_refused(result, name);
    EXPECT_THAT(result.err, HasSubstr("free space"));
    EXPECT_THAT(files_in(folder), IsEmpty()) << name;
  }
}

TEST(Refusal, PatchesAreNotFittedAgain) {
  const fs::path folder = fresh_folder("patches");
  const std::string document = (folder / "a.quad").string();
  ASSERT_EQ(quadrille({sample("formats/one_pixel.png"), "-o", document}).exit_code, 0);
  expect_refused(quadrille({document, "-o", (folder / "b.svg").string()}), "a.quad");
  const std::string drawing = (folder / "b.png").string();
  expect_refused(quadrille({"inspect", document, "--stage", "quads", "-o", drawing}), "a.quad");
  EXPECT_EQ(files_in(folder).size(), 1);
}

TEST(Refusal, MissingPicture) {
  const fs::path folder = fresh_folder("missing");
  expect_refused(quadrille({"nowhere.png", "-o", (folder / "a.svg").string()}), "nowhere.png");
  EXPECT_THAT(files_in(folder), IsEmpty());
}

TEST(Refusal, MissingDensityMap) {
  const fs::path folder = fresh_folder("missing_map");
  const std::string picture = sample("formats/uniform_gray.png");
  const std::string output = (folder / "a.png").string();
  expect_refused(quadrille({picture, "--density", "nowhere.png", "-o", output}), "nowhere.png");
  expect_refused(
      quadrille({"inspect", picture, "--stage", "quads", "--density", "nowhere.png", "-o", output}),
      "nowhere.png");
  EXPECT_THAT(files_in(folder), IsEmpty());
}

TEST(Refusal, OutputsAreCheckedBeforeTheInputIsRead) {
  const fs::path folder = fresh_folder("outputs");
  const std::string good = (folder / "a.svg").string();
  const std::string unread = (folder / "nowhere.png").string();
  expect_refused(quadrille({unread, "-o", good, "-o", (folder / "a.xyz").string()}), "a.xyz");
  expect_refused(quadrille({unread, "-o", (folder / "noending").string()}), "noending");
  expect_refused(quadrille({unread, "-o", good, "-o", (folder / "no/a.svg").string()}), "no/a.svg");
  expect_refused(quadrille({unread, "-o", good, "-o", good}), "twice");
  expect_refused(quadrille({unread, "-o", good, "--report", (folder / "no/r.json").string()}),
                 "r.json");
  expect_refused(quadrille({"render", unread, "-o", good}), "a.svg");
  fs::create_directory(folder / "folder.svg");
  expect_refused(quadrille({unread, "-o", (folder / "folder.svg").string()}), "folder.svg");
  EXPECT_THAT(files_in(folder), ElementsAre("folder.svg"));
}

TEST(Refusal, TheInputIsNeverOverwritten) {
  const fs::path folder = fresh_folder("overwrite");
  const fs::path picture = folder / "one.png";
  fs::copy_file(sample("formats/one_pixel.png"), picture);
  expect_refused(quadrille({picture.string(), "-o", picture.string()}), "overwrite");
  const std::string other = sample("formats/uniform_gray.png");
  expect_refused(quadrille({other, "-o", picture.string(), "--density", picture.string()}),
                 "overwrite");
  const std::string document = (folder / "a.quad").string();
  expect_silent_success(quadrille({picture.string(), "-o", document}));
  expect_refused(quadrille({"render", picture.string(), "-o", picture.string()}), "overwrite");
  if (std::ranges::count(export_endings(), ".vtu") != 0) {
    const fs::path scene = folder / "b.vtu";
    fs::copy_file(picture, scene);
    expect_refused(
        quadrille({"export", document, "-o", scene.string(), "--source", scene.string()}),
        "overwrite");
  }
  EXPECT_EQ(bytes_of(picture), bytes_of(sample("formats/one_pixel.png")));
}

TEST(Refusal, NotADocument) {
  const fs::path folder = fresh_folder("document");
  std::ofstream(folder / "text.quad") << "hello";
  expect_refused(
      quadrille({"export", (folder / "text.quad").string(), "-o", (folder / "a.svg").string()}),
      "text.quad");
  expect_refused(quadrille({"info", (folder / "text.quad").string()}), "text.quad");
  expect_refused(quadrille({"info", (folder / "none.quad").string(), "--json"}), "none.quad");
  EXPECT_THAT(files_in(folder), ElementsAre("text.quad"));
}

TEST(Refusal, WhatCannotBeDrawnNamesTheFile) {
  const fs::path folder = fresh_folder("drawing");
  const std::string picture = sample("formats/one_pixel.png");
  const std::string png = (folder / "a.png").string(), jpg = (folder / "a.jpg").string();
  expect_refused(quadrille({"render", picture, "-o", png, "--region", "0,0,9,9"}), png);
  expect_refused(quadrille({"render", picture, "-o", jpg, "--bits", "16"}), jpg);
  EXPECT_THAT(files_in(folder), IsEmpty());
}

// What lies in the way of a file's companions is named, and stays.
TEST(Refusal, ObstaclesBesideAFile) {
  const fs::path folder = fresh_folder("obstacles");
  const std::string picture = sample("formats/one_pixel.png");
  const auto expect_obstacle = [&](const std::string& output, const std::string& obstacle) {
    const auto before = files_in(folder);
    if (std::ranges::count(export_endings(), fs::path(output).extension().string()) == 0) return;
    const CommandResult result = quadrille({picture, "-o", (folder / output).string()});
    expect_refused(result, output);
    EXPECT_THAT(result.err, HasSubstr("'" + (folder / obstacle).string() + "'"));
    EXPECT_EQ(files_in(folder), before);
  };
  fs::create_directory(folder / "a.bin");
  expect_obstacle("a.gltf", "a.bin");
  std::ofstream(folder / "e-texture-0.png") << "mine";
  expect_obstacle("e.gltf", "e-texture-0.png");
  std::ofstream(folder / "b_vtm") << "mine";
  expect_obstacle("b.vtm", "b_vtm");
  std::ofstream(folder / "b.vtm") << "mine";
  expect_obstacle("b.vtm", "b_vtm");
  fs::create_directory(folder / "c_files");
  expect_obstacle("c.dzi", "c_files");
  const std::string long_name(250, 'd');  // the file's name fits into 255 bytes, the others do not
  expect_obstacle(long_name + ".dzi", long_name + "_files");
  expect_obstacle(long_name + ".gltf", long_name + "-texture-0.png");
  fs::create_symlink("loop.png", folder / "loop.png");
  expect_obstacle("loop.png", "loop.png");
}

TEST(Refusal, AFolderIsToldFromAMissingFile) {
  if (std::ranges::count(import_endings(), ".vtu") == 0) GTEST_SKIP() << "without VTK";
  const fs::path folder = fresh_folder("kinds");
  fs::create_directory(folder / "a.vtu");
  expect_refused(quadrille({"info", (folder / "a.vtu").string()}), "it is a folder");
  expect_refused(quadrille({"info", (folder / "b.vtu").string()}), "no such file");
  expect_refused(quadrille({"info", (folder / "b.vtm").string()}), "no such file");
  const std::string long_name = (folder / (std::string(256, 'c') + ".vtm")).string();
  const CommandResult result = quadrille({"info", long_name});
  expect_refused(result, "cannot read");
  EXPECT_THAT(result.err, Not(HasSubstr("no such file")));
}

TEST(Refusal, TooLargeAScaleIsRefusedBeforeTheWork) {
  const fs::path folder = fresh_folder("scale");
  expect_refused(quadrille({sample("formats/uniform_gray.png"), "-o", (folder / "a.png").string(),
                            "--scale", "1e12"}),
                 "a.png");
  for (const char* scale : {"2000", "1e30", "1e308"}) {
    expect_refused(quadrille({"inspect", sample("formats/uniform_gray.png"), "-o",
                              (folder / "b.png").string(), "--stage", "quads", "--scale", scale}),
                   "b.png");
  }
  EXPECT_THAT(files_in(folder), IsEmpty());
}

TEST(Refusal, AMessageIsOneLineWhateverTheName) {
  expect_refused(quadrille({"no\nsuch\tpicture.png", "-o", (scratch_dir() / "a.svg").string()}),
                 "picture.png");
}

TEST(Refusal, AnInterruptedRunLeavesNothing) {
  const fs::path folder = fresh_folder("interrupt");
  const fs::path log = scratch_dir() / "interrupt.txt";
  // Waits for the first finished stage, so that the signal arrives in the middle of the work.
  const std::string script =
      "log=$1; signal=$2; shift 2; \"$@\" 2>\"$log\" & pid=$!; "
      "until grep -q read \"$log\"; do sleep 0.02; done; kill -$signal $pid; wait $pid";
  for (const int signal : {SIGTERM, SIGHUP}) {
    // Under nohup the command would go on ignoring it.
    const auto handler = std::signal(signal, SIG_DFL);
    fs::remove(log);
    std::ofstream{log};
    const int exit_code = run({"sh", "-c", script, "sh", log.string(), std::to_string(signal),
                               QUADRILLE_COMMAND, sample("formats/exif_portrait_8.jpg"), "-o",
                               (folder / "a.svg").string(), "--quads", "60000", "-v"});
    std::signal(signal, handler);
    EXPECT_EQ(exit_code, 128 + signal);
    EXPECT_THAT(bytes_of(log), HasSubstr("quadrille: cancelled"));
    EXPECT_THAT(files_in(folder), IsEmpty());
  }
}

}  // namespace
}  // namespace quadrille::test
