#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "quadrille/document.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/picture_layers.h"
#include "quadrille/raster_file.h"
#include "support/programs.h"
#include "window_driver.h"

namespace quadrille::viewer {
namespace {

namespace fs = std::filesystem;

struct Result {
  int exit_code = 0;
  std::string text;
};

Result view(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), QUADRILLE_VIEW);
  Result result;
  result.exit_code = test::run(arguments, &result.text);
  return result;
}

void expect_complaint(const Result& result, int exit_code, const std::string& part) {
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_TRUE(result.text.starts_with("quadrille-view: ")) << result.text;
  EXPECT_EQ(std::ranges::count(result.text, '\n'), 1) << result.text;
  EXPECT_NE(result.text.find(part), std::string::npos) << result.text;
}

/// A document and its source in the scratch folder.
struct Files {
  std::string document, source, out;
  Subject subject = small_subject();

  Files() {
    const fs::path folder = test::scratch_dir();
    document = (folder / "small.quad").string();
    source = (folder / "small.png").string();
    out = (folder / "out.png").string();
    fs::remove(out);
    save_document(*subject.image, document, {.encoding = DocumentEncoding::lossless});
    save_raster(*subject.source, source);
  }
};

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ViewCommand, DrawsTheSceneIntoAFile) {
  const Files files;
  const Result result = view({files.document, "--screenshot", files.out, "--zoom", "3.5",
                              "--center", "20.5,30", "--size", "200x150"});
  ASSERT_EQ(result.exit_code, 0) << result.text;
  EXPECT_EQ(result.text, "");
  View there({64, 48}, {200, 150});
  there.zoom_to(3.5);
  there.look_at({20.5, 30});
  expect_same(expected_picture(files.subject, there.frame()), load_image(files.out), 1, "command");
}

TEST(ViewCommand, OpensASceneFileWithTheSourceThatItKeeps) {
  const Files files;
  const std::string scene = (test::scratch_dir() / "small.vtm").string();
  const Raster source = load_image(files.source);
  write_vtm({64, 48, {picture_group(files.subject.image, &source)}}, scene);
  const std::vector<std::string> options = {
      "--screenshot", files.out,  "--compare",
      "0.4",          "--layers", "picture,error:0.3,patches,cross-field"};
  std::string first;
  for (std::vector<std::string> input :
       {std::vector{scene}, std::vector{files.document, std::string("--source"), files.source}}) {
    input.insert(input.end(), options.begin(), options.end());
    const Result result = view(input);
    ASSERT_EQ(result.exit_code, 0) << result.text;
    const std::string bytes = bytes_of(files.out);
    EXPECT_EQ(bytes, first.empty() ? bytes : first);
    first = bytes;
  }
}

TEST(ViewCommand, ShowsThePatchesOfASceneFileWhosePictureIsLost) {
  const Files files;
  const fs::path scene = test::scratch_dir() / "lost.vtm";
  const Raster source = load_image(files.source);
  write_vtm({64, 48, {picture_group(files.subject.image, &source)}}, scene);
  const fs::path pixels = test::scratch_dir() / "lost_vtm" / "picture_picture.vti";
  const std::vector<std::string> shown = {scene.string(), "--screenshot", files.out};
  ASSERT_EQ(view(shown).exit_code, 0);
  const std::string whole = bytes_of(files.out);
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), shown.begin(), shown.end());
    fs::remove(files.out);
    return view(arguments);
  };
  for (const bool is_missing : {false, true}) {
    std::ofstream(pixels) << "damaged";
    if (is_missing) fs::remove(pixels);
    expect_complaint(with({}), 0, "shown without its source");
    EXPECT_EQ(bytes_of(files.out), whole);
    expect_complaint(with({"--compare", "0.4"}), 1, "picture_picture.vti");
    expect_complaint(with({"--quads", "30"}), 1, "picture_picture.vti");
    const Result error = with({"--layers", "error"});
    EXPECT_EQ(error.exit_code, 1);
    EXPECT_NE(error.text.find("needs a source"), std::string::npos) << error.text;
    EXPECT_EQ(with({"--source", files.source, "--compare", "0.4"}).text, "");
  }
}

TEST(ViewCommand, GivesTheSameBytesForAnyThreadCount) {
  const Files files;
  std::string first;
  for (const char* threads : {"1", "3"}) {
    const Result result =
        view({files.source, "--screenshot", files.out, "--quads", "90", "--threads", threads,
              "--panels", "--compare", "0.4", "--layers",
              "picture,source,error:0.3,scales:0.5,control-net,patches,tears,irregular-vertices,"
              "cross-field,singularities"});
    ASSERT_EQ(result.exit_code, 0) << result.text;
    const std::string bytes = bytes_of(files.out);
    EXPECT_EQ(bytes, first.empty() ? bytes : first);
    first = bytes;
  }
}

TEST(ViewCommand, WithoutADisplayItNamesXvfb) {
  const Files files;
  for (const char* display : {"DISPLAY=", "DISPLAY=:4711"}) {
    Result result;
    result.exit_code = test::run({"env", display, QUADRILLE_VIEW, files.document}, &result.text);
    expect_complaint(result, 1, "xvfb-run");
  }
}

TEST(ViewCommand, RefusesAWrongCommandLine) {
  const Files files;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {files.document, "--size", "10"},
                                             {files.document, "--size", "0x100"},
                                             {files.document, "--center", "1;2"},
                                             {files.document, "--zoom", "0"},
                                             {files.document, "--compare", "2"},
                                             {files.document, "--compare", "nan"},
                                             {files.document, "--compare", "0.5"},
                                             {files.document, "--quads", "30"},
                                             {files.document, "--panels"},
                                             {files.document, "--layers", "pictures"},
                                             {files.source, "--source", files.source},
                                             {files.document, "--turn", "90"}}) {
    expect_complaint(view(arguments), 2, "");
  }
}

TEST(ViewCommand, RefusesWhatCannotBeShown) {
  const Files files;
  const std::string small = (test::scratch_dir() / "other.png").string();
  save_raster(Raster(20, 10, 3), small);
  expect_complaint(view({"nothing.quad", "--screenshot", files.out}), 1, "nothing.quad");
  expect_complaint(view({files.document, "--screenshot", files.out, "--layers", "error"}), 1,
                   "needs a source");
  expect_complaint(view({files.document, "--screenshot", files.out, "--source", small}), 1,
                   "20 x 10");
  expect_complaint(view({files.document, "--screenshot", "out.jpg"}), 1, ".jpg");
  expect_complaint(view({files.document, "--screenshot", ""}), 2, "empty");
  expect_complaint(view({files.document, "--source", files.source, "--screenshot", files.source}),
                   1, "overwrite");
  EXPECT_FALSE(fs::exists(files.out));
}

}  // namespace
}  // namespace quadrille::viewer
