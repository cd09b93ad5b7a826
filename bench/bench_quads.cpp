// The paper's evaluation of the quadrangulation over folders of pictures, as tables: singularities
// (Table 1), cost (Table 2), boundary recall (Fig. 12), shape, and how well fitted patches do.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "own_process.h"
#include "pictures.h"
#include "program.h"
#include "quads/baseline.h"
#include "quads/field_phases.h"
#include "quads/growth.h"
#include "quads/picture_figures.h"
#include "quads/recall_figures.h"
#include "quads/tables.h"

namespace {

namespace fs = std::filesystem;
using namespace quadrille::bench;
using Json = nlohmann::ordered_json;

const fs::path kBaseline = fs::path(QUADRILLE_SOURCE_DIR) / "bench/baseline_0.1.json";
const fs::path kGrowthPicture =
    fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures/animal_chelsea.png";

struct Options {
  PictureChoice choice;
  PictureOptions picture;
  bool recall = true, slic = true, growth = true, quality = true;
  std::string json_file, baseline_file;
  std::vector<std::string> folders;
};

/// Drawings of people beside the pictures, as the Berkeley segmentation data has them.
fs::path drawings_of(const fs::path& folder) { return folder / "gt"; }

Json figures_of(const fs::path& picture, const Options& options) {
  Json figures = Json::object();
  if (options.quality) {
    figures = run_in_own_process([&] { return picture_figures(picture, options.picture); });
  }
  const fs::path drawings = drawings_of(picture.parent_path());
  if (!options.recall || !fs::is_directory(drawings) || figures.contains("error")) return figures;
  Json recall = run_in_own_process([&] {
    return recall_figures(picture, drawings, {options.slic, options.picture.threads});
  });
  if (recall.is_object()) return recall;  // an error
  figures["recall"] = std::move(recall);
  return figures;
}

/// The rows of the pictures that went through; the others are named on standard error.
std::vector<TableRow> run_folder(const fs::path& folder, const Options& options, bool& good) {
  std::vector<TableRow> rows;
  for (const fs::path& picture : pictures_in(folder, options.choice)) {
    Json figures = figures_of(picture, options);
    if (figures.contains("error")) {
      fmt::print(stderr, "{}: {}\n", picture.string(), figures["error"].get<std::string>());
      good = false;
    } else if (!figures.empty()) {
      rows.push_back({picture.stem().string(), std::move(figures)});
    }
  }
  return rows;
}

void print_folder(const fs::path& folder, const std::vector<TableRow>& rows,
                  const Options& options) {
  const std::string of = fmt::format("{}, {} quads wished, {} pictures", folder.string(),
                                     options.picture.quads, rows.size());
  if (options.quality) {
    print_fields(of, rows);
    print_cost(of, rows);
    print_shape(of, rows);
    print_fit(of, rows);
  }
  if (rows.front().json.contains("recall")) {
    print_recall(fmt::format("{}, {} pictures", folder.string(), rows.size()), rows);
    if (options.slic && !rows.front().json["recall"][0].contains("slic")) {
      fmt::print("  SLIC: not built, OpenCV's ximgproc was not found\n");
    }
  }
}

Json print_growth_tables(int threads, bool& good) {
  const std::string of = kGrowthPicture.filename().string() + " enlarged";
  Json all = Json::array();
  const auto add = [&](const std::string& what, const std::vector<TableRow>& rows) {
    print_growth(what + ", " + of, rows);
    for (const TableRow& row : rows) {
      good &= !row.json.contains("error");
      all.push_back(row.json);
    }
  };
  add("growth with quads", growth_with_quads(kGrowthPicture, threads));
  add("growth with pixels", growth_with_pixels(kGrowthPicture, threads));
  add("12 megapixels", large_picture(kGrowthPicture, threads));
  return all;
}

bool run(const Options& options) {
  bool good = true;
  Json results;
  std::vector<TableRow> all;
  for (const fs::path& folder : picture_folders(options.folders)) {
    std::vector<TableRow> rows = run_folder(folder, options, good);
    if (rows.empty()) continue;
    match_local_smoothing(rows);
    if (options.quality && options.baseline_file.empty()) {
      add_baseline(rows, kBaseline, options.picture.quads);
    }
    print_folder(folder, rows, options);
    results["folders"][folder.string()] = as_json(rows);
    all.insert(all.end(), rows.begin(), rows.end());
  }
  if (options.growth) results["growth"] = print_growth_tables(options.picture.threads, good);
  if (!options.baseline_file.empty()) {
    write_baseline(all, options.baseline_file, options.picture.quads);
  }
  return write_json(results, options.json_file) && good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App parser("The quadrangulation's singularities, cost, shape and boundary recall");
  Options options;
  bool no_slic = false, no_growth = false, no_recall = false, no_quality = false;
  parser.add_option("--quads", options.picture.quads, "wished quads, but for recall and growth")
      ->check(CLI::Range(1, 2'000'000));
  parser.add_option("--threads", options.picture.threads, "worker threads, 0 for all");
  parser.add_option("--only", options.choice.only, "only pictures whose name has this text");
  parser.add_option("--limit", options.choice.limit, "at most this many pictures per folder");
  parser.add_flag("--no-slic", no_slic, "recall without SLIC beside it");
  parser.add_flag("--no-recall", no_recall, "leave boundary recall out");
  parser.add_flag("--no-growth", no_growth, "leave the growth with quads and pixels out");
  parser.add_flag("--no-quality", no_quality, "only recall and growth");
  parser.add_option("--json", options.json_file, "also write all figures to this file");
  parser.add_option("--write-baseline", options.baseline_file,
                    "store the figures that later versions are compared with in this file");
  parser.add_option("FOLDERS", options.folders, "folders to run instead of the usual ones");
  CLI11_PARSE(parser, argc, argv);
  options.slic = !no_slic;
  options.recall = !no_recall;
  options.growth = !no_growth;
  options.quality = !no_quality;
  return exit_code([&] { return run(options); });
}
