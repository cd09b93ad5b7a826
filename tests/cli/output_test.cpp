// What the sub-commands write, read back through the library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "quadrille/document.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"

namespace quadrille::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The arguments -o folder/picture.ending for every format of this build.
std::vector<std::string> every_output(const fs::path& folder) {
  std::vector<std::string> arguments;
  for (const std::string& ending : export_endings()) {
    arguments.insert(arguments.end(), {"-o", (folder / ("picture" + ending)).string()});
  }
  return arguments;
}

/// The files and folders that every_output() leaves: the tiles of .dzi and the pieces of .vtm lie
/// in folders beside them, and the data and the texture of .gltf, if it shows anything, in two
/// files.
std::size_t files_of_every_output(bool shows_anything = true) {
  const auto has = [](const char* ending) { return std::ranges::count(export_endings(), ending); };
  return export_endings().size() + 1 + (has(".gltf") && shows_anything ? 2 : 0) + has(".vtm");
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  ASSERT_EQ(files_in(a), files_in(b));
  for (const std::string& name : files_in(a)) {
    if (fs::is_directory(a / name)) {
      expect_same_files(a / name, b / name);
      continue;
    }
    EXPECT_TRUE(bytes_of(a / name) == bytes_of(b / name)) << name << " differs";
  }
}

class Output : public testing::Test {
 protected:
  static const std::string& picture() {
    static const std::string path = sample("formats/coast_progressive.jpg");
    return path;
  }
  /// A document of the picture, made once.
  static const std::string& document() {
    static const std::string path = [] {
      const fs::path file = fresh_folder("document_of_coast") / "coast.quad";
      expect_silent_success(quadrille({picture(), "-o", file.string(), "--quads", "200"}));
      return file.string();
    }();
    return path;
  }
};

TEST_F(Output, ExportShowsTheErrorOfTheSource) {
  if (std::ranges::count(export_endings(), ".vtm") == 0) GTEST_SKIP() << "without VTK";
  const fs::path folder = fresh_folder("source");
  const std::string scene = (folder / "a.vtm").string(), again = (folder / "b.vtm").string();
  expect_silent_success(quadrille({"export", document(), "--source", picture(), "-o", scene}));
  EXPECT_TRUE(fs::exists(folder / "a_vtm" / "picture_error.vti"));
  expect_silent_success(quadrille({"export", scene, "-o", again}));
  expect_same_files(folder / "a_vtm", folder / "b_vtm");

  const std::string other = sample("formats/one_pixel.png");
  EXPECT_EQ(quadrille({"export", document(), "--source", other, "-o", scene}).exit_code, 1);
  EXPECT_EQ(
      quadrille({"export", document(), "--source", picture(), "-o", (folder / "a.svg").string()})
          .exit_code,
      2);
}

TEST_F(Output, EveryFormatIsTheSameForAnyThreadCountAndFromTheDocument) {
  const fs::path first = fresh_folder("threads_1");
  expect_silent_success(
      quadrille(join({"vectorize", picture(), "--quads", "200", "--lossless", "--threads", "1"},
                     every_output(first))));
  EXPECT_EQ(files_in(first).size(), files_of_every_output());

  for (const std::string threads : {"2", "3"}) {
    const fs::path other = fresh_folder("threads_" + threads);
    expect_silent_success(quadrille(
        join({"vectorize", picture(), "--quads", "200", "--lossless", "--threads", threads},
             every_output(other))));
    expect_same_files(first, other);
  }

  const fs::path exported = fresh_folder("exported");
  expect_silent_success(quadrille(
      join({"export", (first / "picture.quad").string(), "--lossless"}, every_output(exported))));
  // A document knows neither the picture's errors nor the fields.
  for (const fs::path& folder : {first, exported}) {
    for (const char* name : {"picture.vtu", "picture.vtm", "picture_vtm"}) {
      fs::remove_all(folder / name);
    }
  }
  expect_same_files(first, exported);
}

TEST_F(Output, ShortFormIsVectorize) {
  const fs::path folder = fresh_folder("short");
  expect_silent_success(quadrille(
      {"vectorize", picture(), "-o", (folder / "coast.quad").string(), "--quads", "200"}));
  EXPECT_TRUE(bytes_of(folder / "coast.quad") == bytes_of(document()));
}

TEST_F(Output, TheDocumentHasTheWishedSize) {
  const VectorImage image = load_document(document());
  EXPECT_NEAR(image.patch_count(), 200, 20);
  EXPECT_EQ(image.metadata.at("source"), "coast_progressive.jpg");
}

TEST_F(Output, ADocumentOfAnExactFitIsRoundedFinely) {
  const fs::path folder = fresh_folder("exact_fit");
  const std::string smooth = sample("pictures/smooth_freeform_gradient.png");
  const std::string file = (folder / "smooth.quad").string();
  expect_silent_success(quadrille({smooth, "-o", file, "--quads", "1500", "--optimize", "0"}));
  EXPECT_LT(compare(load_image(smooth), render(load_document(file))).mae, 0.2);
}

TEST_F(Output, ADensityMapMovesQuadsUnlessItIsConstant) {
  const fs::path folder = fresh_folder("density");
  const std::string same = (folder / "same.quad").string();
  const std::string moved = (folder / "moved.quad").string();
  expect_silent_success(quadrille(
      {picture(), "-o", same, "--quads", "200", "--density", sample("formats/uniform_gray.png")}));
  EXPECT_TRUE(bytes_of(same) == bytes_of(document()));
  expect_silent_success(
      quadrille({picture(), "-o", moved, "--quads", "200", "--density", picture()}));
  EXPECT_FALSE(bytes_of(moved) == bytes_of(document()));
  EXPECT_NEAR(load_document(moved).patch_count(), 200, 20);
}

TEST_F(Output, EndingsMayBeInUpperCase) {
  const fs::path folder = fresh_folder("upper");
  expect_silent_success(quadrille({"export", document(), "-o", (folder / "A.PNG").string()}));
  EXPECT_EQ(load_image(folder / "A.PNG").width, 250);
}

TEST_F(Output, ScaleSetsTheSizeOfPixelFormats) {
  const fs::path folder = fresh_folder("scale");
  expect_silent_success(
      quadrille({"export", document(), "-o", (folder / "a.png").string(), "--scale", "1.5"}));
  EXPECT_EQ(load_image(folder / "a.png").width, 375);
  expect_silent_success(
      quadrille({"render", document(), "-o", (folder / "b.png").string(), "--width", "375"}));
  EXPECT_TRUE(bytes_of(folder / "a.png") == bytes_of(folder / "b.png"));
}

TEST_F(Output, ARegionIsTheCropOfTheWhole) {
  const fs::path folder = fresh_folder("region");
  const std::string whole = (folder / "whole.png").string();
  const std::string part = (folder / "part.png").string();
  expect_silent_success(
      quadrille({"render", document(), "-o", whole, "--scale", "3", "--bits", "16"}));
  expect_silent_success(quadrille({"render", document(), "-o", part, "--scale", "3", "--bits", "16",
                                   "--region", "101,37,60,50"}));
  EXPECT_EQ(load_image(part), crop(load_image(whole), 101, 37, 60, 50));

  const CommandResult outside =
      quadrille({"render", document(), "-o", part, "--scale", "3", "--region", "700,0,60,50"});
  EXPECT_EQ(outside.exit_code, 1);
  EXPECT_THAT(outside.err, HasSubstr("750 x 750"));
}

TEST_F(Output, RenderTakesAPictureToo) {
  const fs::path folder = fresh_folder("render_picture");
  expect_silent_success(
      quadrille({"render", picture(), "-o", (folder / "a.png").string(), "--quads", "200"}));
  const std::string lossless = (folder / "lossless.quad").string();
  expect_silent_success(quadrille({picture(), "-o", lossless, "--quads", "200", "--lossless"}));
  expect_silent_success(quadrille({"render", lossless, "-o", (folder / "b.png").string()}));
  EXPECT_TRUE(bytes_of(folder / "a.png") == bytes_of(folder / "b.png"));

  // The quantised document looks the same.
  expect_silent_success(quadrille({"render", document(), "-o", (folder / "c.png").string()}));
  EXPECT_LT(compare(load_image(folder / "a.png"), load_image(folder / "c.png")).mae, 0.3);
}

TEST_F(Output, CompareMeasuresAndDecides) {
  const CommandResult same = quadrille({"compare", picture(), picture(), "--max-mae", "0"});
  EXPECT_EQ(same.exit_code, 0);
  EXPECT_EQ(same.out, "MAE  0.0000\nPSNR 99.000 dB\nSSIM 1.00000\n");

  const fs::path rendered = fresh_folder("compare") / "coast.png";
  expect_silent_success(quadrille({"render", document(), "-o", rendered.string()}));
  const ImageDifference expected = compare(load_image(picture()), load_image(rendered));
  const CommandResult json = quadrille({"compare", picture(), rendered.string(), "--json"});
  const auto values = nlohmann::json::parse(json.out);
  EXPECT_DOUBLE_EQ(values["mae"], expected.mae);
  EXPECT_DOUBLE_EQ(values["psnr"], expected.psnr);
  EXPECT_DOUBLE_EQ(values["ssim"], expected.ssim);

  const CommandResult above =
      quadrille({"compare", picture(), rendered.string(), "--max-mae", "0.01"});
  EXPECT_EQ(above.exit_code, 1);
  EXPECT_TRUE(is_one_complaint(above.err)) << above.err;

  const std::string tiny = sample("formats/one_pixel.png");
  EXPECT_EQ(quadrille({"compare", tiny, tiny}).out,
            "MAE  0.0000\nPSNR 99.000 dB\nSSIM undefined below 7 x 7 pixels\n");
  EXPECT_TRUE(
      nlohmann::json::parse(quadrille({"compare", tiny, tiny, "--json"}).out)["ssim"].is_null());

  const CommandResult sizes = quadrille({"compare", picture(), tiny});
  EXPECT_EQ(sizes.exit_code, 1);
  EXPECT_THAT(sizes.err, HasSubstr("250 x 250"));
}

TEST_F(Output, TheReportTellsEverything) {
  const fs::path folder = fresh_folder("report");
  const fs::path file = folder / "report.json";
  expect_silent_success(quadrille({picture(), "-o", (folder / "a.svg").string(), "--quads", "200",
                                   "--fit", "bessel", "--report", file.string()}));
  const auto report = nlohmann::json::parse(bytes_of(file));
  EXPECT_EQ(report["source"], "coast_progressive.jpg");
  EXPECT_EQ(report["width"], 250);
  EXPECT_EQ(report["height"], 250);
  EXPECT_EQ(report["options"]["quads"], 200);
  EXPECT_EQ(report["options"]["fit"], "bessel");
  EXPECT_NEAR(report["quads"].get<int>(), 200, 20);
  EXPECT_EQ(report["options"]["tears"], "auto");
  EXPECT_GE(report["tears"]["chains"].get<int>(), report["tears"]["torn"].get<int>());
  EXPECT_EQ(report["tears"]["torn"] > 0, report["tears"]["length"] > 0);
  EXPECT_EQ(report["folded"], 0);
  EXPECT_EQ(report["fallback"], false);
  EXPECT_EQ(report["uncovered_pixels"], 0);
  EXPECT_EQ(report["doubly_covered_pixels"], 0);
  EXPECT_EQ(report["outputs"][0]["file"], "a.svg");
  EXPECT_EQ(report["outputs"][0]["bytes"], fs::file_size(folder / "a.svg"));
  EXPECT_GT(report["peak_memory_mb"].get<double>(), 1);
  for (const char* number : {"vertices", "irregular_vertices", "misalignment_degrees", "mae",
                             "psnr", "ssim", "seconds", "cpu_seconds"}) {
    EXPECT_TRUE(report[number].is_number()) << number;
  }
  EXPECT_TRUE(report["singularities"]["positive"].is_number());
  EXPECT_TRUE(report["singularities"]["negative"].is_number());
  ASSERT_EQ(report["cross_field"].size(), 3);
  EXPECT_EQ(report["cross_field"][0]["name"], "smooth");
  EXPECT_EQ(report["cross_field"][2]["name"], "cancelled");
  for (const char* figure : {"positive", "negative"}) {
    EXPECT_EQ(report["cross_field"][2][figure], report["singularities"][figure]);
  }
  EXPECT_EQ(report["cross_field"][2]["misalignment_degrees"], report["misalignment_degrees"]);
  EXPECT_EQ(report["options"]["field"], "smooth");
  EXPECT_TRUE(report["error_bound"].is_null());
  ASSERT_FALSE(report["stages"].empty());
  for (const auto& stage : report["stages"]) EXPECT_GE(stage["seconds"].get<double>(), 0);
}

TEST_F(Output, ThePresetIsChosenByContentOrNamed) {
  const fs::path folder = fresh_folder("preset");
  const auto report_of = [&](const std::string& name, const std::vector<std::string>& options) {
    expect_silent_success(
        quadrille(join({sample(name), "--lattice", "-o", (folder / "a.quad").string(), "--report",
                        (folder / "r.json").string()},
                       options)));
    return nlohmann::json::parse(bytes_of(folder / "r.json"));
  };
  const auto flat = report_of("formats/uniform_gray.png", {});
  EXPECT_EQ(flat["options"]["preset"], "auto");
  EXPECT_EQ(flat["preset"]["name"], "graphic");
  EXPECT_EQ(flat["preset"]["flat_share"], 1);
  EXPECT_EQ(flat["preset"]["main_colors"], 1);
  EXPECT_EQ(flat["options"]["quads"], 3000);
  const auto draft = report_of("formats/uniform_gray.png", {"--preset", "draft"});
  EXPECT_EQ(draft["preset"]["name"], "draft");
  EXPECT_FALSE(draft["preset"].contains("flat_share"));
  EXPECT_EQ(draft["options"]["quads"], 300);
  EXPECT_EQ(report_of("formats/coast_progressive.jpg", {})["preset"]["name"], "photo");
  const auto counted =
      report_of("formats/coast_progressive.jpg", {"--preset", "fine", "--quads", "150"});
  EXPECT_EQ(counted["preset"]["name"], "fine");
  EXPECT_EQ(counted["options"]["quads"], 150);
}

TEST_F(Output, TheReportTellsOfTears) {
  const fs::path folder = fresh_folder("tears");
  const auto report_with = [&](const std::string& mode) {
    expect_silent_success(
        quadrille({sample("pictures/ring_256_alpha.png"), "--quads", "400", "--tears", mode, "-o",
                   (folder / "a.quad").string(), "--report", (folder / "r.json").string()}));
    return nlohmann::json::parse(bytes_of(folder / "r.json"));
  };
  const auto strong = report_with("strong");
  EXPECT_EQ(strong["options"]["tears"], "strong");
  EXPECT_GT(strong["tears"]["torn"], 0);
  EXPECT_EQ(strong["tears"]["torn"], strong["tears"]["chains"]);
  const auto info =
      nlohmann::json::parse(quadrille({"info", (folder / "a.quad").string(), "--json"}).out);
  EXPECT_GT(info["tears"]["length"].get<double>(), 0);
  EXPECT_NEAR(strong["tears"]["length"].get<double>(), info["tears"]["length"].get<double>(),
              0.01 * info["tears"]["length"].get<double>());
  const auto off = report_with("off");
  EXPECT_EQ(off["options"]["tears"], "off");
  EXPECT_EQ(off["tears"], (nlohmann::json{{"chains", 0}, {"torn", 0}, {"length", 0.0}}));
}

TEST_F(Output, TheErrorKeepsWithinItsBound) {
  const fs::path folder = fresh_folder("max_error");
  const auto run_with = [&](const std::string& error, const std::string& quads) {
    return quadrille({picture(), "--lattice", "--max-error", error, "--quads", quads, "-o",
                      (folder / "a.quad").string(), "--report", (folder / "r.json").string()});
  };
  const auto report = [&] { return nlohmann::json::parse(bytes_of(folder / "r.json")); };
  expect_silent_success(run_with("12", "5000"));
  EXPECT_EQ(report()["error_bound"]["met"], true);
  EXPECT_EQ(report()["error_bound"]["wished"], 12);
  EXPECT_EQ(report()["options"]["quads"], report()["error_bound"]["rounds"][0]["wished"]);
  EXPECT_LE(report()["mae"].get<double>(), 12);
  EXPECT_FALSE(report()["error_bound"]["rounds"].empty());
  EXPECT_LE(report()["quads"].get<int>(), 5000 * 1.05);

  const CommandResult missed = run_with("0.01", "100");
  EXPECT_EQ(missed.exit_code, 0);
  EXPECT_TRUE(is_one_complaint(missed.err)) << missed.err;
  EXPECT_THAT(missed.err, HasSubstr("warning"));
  EXPECT_EQ(report()["error_bound"]["met"], false);
}

TEST_F(Output, TheLatticeHasNoIrregularVertex) {
  const fs::path folder = fresh_folder("lattice");
  expect_silent_success(quadrille({picture(), "-o", (folder / "a.quad").string(), "--quads", "200",
                                   "--lattice", "--report", (folder / "r.json").string()}));
  const auto report = nlohmann::json::parse(bytes_of(folder / "r.json"));
  EXPECT_EQ(report["irregular_vertices"], 0);
  EXPECT_EQ(report["options"]["lattice"], true);
}

TEST_F(Output, ReportsTheOpaqueRegion) {
  const fs::path folder = fresh_folder("opaque");
  const auto report_on = [&](const std::string& name) {
    expect_silent_success(
        quadrille({sample(name), "-o", (folder / "a.quad").string(), "--quads", "300", "--mesh",
                   "opaque", "--report", (folder / "r.json").string()}));
    return nlohmann::json::parse(bytes_of(folder / "r.json"));
  };
  const auto ring = report_on("pictures/ring_256_alpha.png");
  EXPECT_EQ(ring["options"]["mesh"], "opaque");
  EXPECT_EQ(ring["region"]["mesh"], "opaque");
  EXPECT_EQ(ring["region"]["components"], 1);
  EXPECT_EQ(ring["region"]["holes"], 5);
  EXPECT_GT(ring["region"]["outline_length"], 1000);
  EXPECT_EQ(ring["doubly_covered_pixels"], 0);
  const auto coast = report_on("formats/coast_progressive.jpg");
  EXPECT_EQ(coast["options"]["mesh"], "opaque");
  EXPECT_EQ(coast["region"]["mesh"], "whole");
  EXPECT_EQ(coast["region"]["holes"], 0);
}

TEST_F(Output, VerboseTellsAStageALine) {
  const fs::path folder = fresh_folder("verbose");
  const CommandResult result =
      quadrille({picture(), "-o", (folder / "a.svg").string(), "--quads", "200", "-v"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  for (const char* stage : {"read", "preset photo", "cross field", "write .svg", "MAE"}) {
    EXPECT_THAT(result.err, HasSubstr(stage));
  }
  EXPECT_EQ(result.err.find('\r'), std::string::npos);
}

TEST(TinyPictures, GoThroughInEveryFormat) {
  for (const char* name : {"one_pixel.png", "row_1000x1.png", "fully_transparent.png"}) {
    SCOPED_TRACE(name);
    const fs::path folder = fresh_folder("tiny");
    expect_silent_success(quadrille(join({sample(std::string("formats/") + name), "--quads", "200",
                                          "--report", (folder / "r.json").string()},
                                         every_output(folder))));
    const bool shows_anything = std::string(name) != "fully_transparent.png";
    EXPECT_EQ(files_in(folder).size(),
              files_of_every_output(shows_anything) + 1);  // and the report
  }
}

}  // namespace
}  // namespace quadrille::test
