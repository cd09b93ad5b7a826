// How faithful patches are, over folders of pictures, as tables: every way of estimating colours on
// the mesh and on the lattice, beside a JPEG of equal size; reduced pictures enlarged again; and
// the solvers' iterations against the size of the picture.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "fit/fit_figures.h"
#include "fit/size_growth.h"
#include "fit/tables.h"
#include "fit/upscale.h"
#include "own_process.h"
#include "pictures.h"
#include "program.h"
#include "quadrille/image_file.h"
#include "quadrille/preset.h"

namespace {

namespace fs = std::filesystem;
using namespace quadrille::bench;
using Json = nlohmann::ordered_json;

const fs::path kGrowthPicture =
    fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures/animal_chelsea.png";

struct Options {
  PictureChoice choice;
  std::vector<int> quads = {2700, 8000};
  std::vector<std::string> fits;
  FitFigureOptions figures;
  UpscaleOptions upscale;
  bool no_fit = false, no_jpeg = false, no_upscale = false, no_growth = false;
  std::string json_file;
  std::vector<std::string> folders;
};

/// The name of the preset that the picture's content asks for, or an error.
Json kind_of(const fs::path& picture) {
  return run_in_own_process(
      [&]() -> Json { return quadrille::choose_preset(quadrille::load_image(picture)).name; });
}

/// The picture's figures; names the runs that failed on standard error.
Json figures_of(const fs::path& picture, const std::vector<FitRun>& runs, const Options& options,
                bool& good) {
  Json all = Json::object();
  const auto keep = [&](const std::string& place, Json figures) {
    if (figures.contains("error")) {
      fmt::print(stderr, "{}, {}: {}\n", picture.string(), place,
                 figures["error"].get<std::string>());
      good = false;
    } else {
      all[Json::json_pointer(place)] = std::move(figures);
    }
  };
  keep("/preset", kind_of(picture));
  for (const FitRun& run : runs) keep(place_of(run), fit_figures(picture, run, options.figures));
  if (!options.no_upscale) keep("/upscale", upscale_figures(picture, options.upscale));
  return all;
}

std::vector<TableRow> run_folder(const fs::path& folder, const std::vector<FitRun>& runs,
                                 const Options& options, bool& good) {
  std::vector<TableRow> rows;
  for (const fs::path& picture : pictures_in(folder, options.choice)) {
    Json figures = figures_of(picture, runs, options, good);
    if (figures.size() > 1) rows.push_back({picture.stem().string(), std::move(figures)});
  }
  if (rows.empty()) return rows;
  const std::string of = fmt::format("{}, {} pictures", folder.string(), rows.size());
  if (!runs.empty()) {
    print_quality(of, runs, rows);
    print_means(of, runs, rows);
    const auto kinds = by_preset(rows);
    for (const auto& [kind, members] : kinds) {
      if (kinds.size() > 1) print_means(fmt::format("{}, {}", kind, members.size()), runs, members);
    }
  }
  if (!options.no_upscale) print_upscale(of, rows);
  return rows;
}

bool run(const Options& options) {
  bool good = true;
  Json results;
  const std::vector<FitRun> runs =
      options.no_fit ? std::vector<FitRun>() : fit_runs(options.fits, options.quads);
  if (!options.no_fit || !options.no_upscale) {
    for (const fs::path& folder : picture_folders(options.folders)) {
      results["folders"][folder.string()] = as_json(run_folder(folder, runs, options, good));
    }
  }
  if (!options.no_growth) {
    const std::vector<TableRow> rows =
        iterations_with_size(kGrowthPicture, options.quads.front(), options.figures.threads);
    print_size_growth(kGrowthPicture.filename().string() + " enlarged", rows);
    results["growth"] = as_json(rows);
    for (const TableRow& row : rows) good &= !row.json.contains("error");
  }
  return write_json(results, options.json_file) && good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App parser("Fidelity of the patches, their size, and enlargements beside filters");
  Options options;
  parser.add_option("--quads", options.quads, "wished quads; several numbers are allowed")
      ->check(CLI::Range(1, 2'000'000))
      ->delimiter(',');
  parser.add_option("--fits", options.fits, "only these ways of estimating colours")
      ->delimiter(',');
  parser
      .add_option("--upscale-quads", options.upscale.quads,
                  "wished quads of the reduced drawings; 0: their preset's")
      ->check(CLI::Range(0, 2'000'000));
  parser
      .add_option("--upscale-photo-quads", options.upscale.photo_quads,
                  "those of the reduced photographs")
      ->check(CLI::Range(1, 2'000'000));
  parser.add_option("--threads", options.figures.threads, "worker threads, 0 for all");
  parser.add_option("--only", options.choice.only, "only pictures whose name has this text");
  parser.add_option("--limit", options.choice.limit, "at most this many pictures per folder");
  parser.add_flag("--no-fit", options.no_fit, "leave the fits at 1x out");
  parser.add_flag("--no-files", options.no_jpeg, "leave the JPEGs of equal size out");
  parser.add_flag("--no-upscale", options.no_upscale, "leave the enlargements out");
  parser.add_flag("--no-growth", options.no_growth, "leave the iterations against size out");
  parser.add_option("--json", options.json_file, "also write all figures to this file");
  parser.add_option("FOLDERS", options.folders, "folders to run instead of the usual ones");
  CLI11_PARSE(parser, argc, argv);
  options.figures.jpeg = !options.no_jpeg;
  options.upscale.threads = options.figures.threads;
  return exit_code([&] { return run(options); });
}
