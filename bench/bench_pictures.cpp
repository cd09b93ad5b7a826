// Quality, time, memory and file sizes over folders of pictures, as tables.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "picture_run.h"
#include "pictures.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using quadrille::bench::PictureChoice;
using quadrille::bench::PictureRunOptions;
using quadrille::bench::pictures_in;
using quadrille::bench::run_picture;

constexpr int kNameWidth = 26;
const std::vector<std::string> kMethods = {"hermite", "bessel", "lattice"};
const std::vector<std::string> kEndings = {".quad", ".svg", ".svg.gz", ".pdf", ".glb", ".vtu"};

struct Row {
  std::string name;
  Json json;
};

/// The mean of a number over the rows that have it.
double mean(const std::vector<Row>& rows, const Json::json_pointer& at) {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows) {
    if (!row.json.contains(at) || !row.json[at].is_number()) continue;
    sum += row.json[at].get<double>();
    ++count;
  }
  return count ? sum / count : 0;
}

/// Every number of the rows replaced by its mean.
Row mean_row(const std::vector<Row>& rows) {
  Json result;
  for (const Row& row : rows) {
    const Json flat = row.json.flatten();
    for (const auto& [key, value] : flat.items()) {
      if (value.is_number() && !result.contains(key)) {
        result[key] = mean(rows, Json::json_pointer(key));
      }
    }
  }
  return {"mean", result.is_null() ? result : result.unflatten()};
}

void print_quality(const std::vector<Row>& rows) {
  fmt::print("{:{}}", "", kNameWidth);
  for (const std::string& method : kMethods) fmt::print(" | {:^30}", method);
  fmt::print("\n{:{}}", "picture", kNameWidth);
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    fmt::print(" | {:>7} {:>6} {:>7} {:>7}", "quads", "MAE", "PSNR", "SSIM");
  }
  fmt::print("\n");
  for (const Row& row : rows) {
    fmt::print("{:{}}", row.name, kNameWidth);
    for (const std::string& method : kMethods) {
      const Json& m = row.json[method];
      // A picture with a side below the SSIM window has none.
      const double ssim = m["ssim"].is_number() ? m["ssim"].get<double>() : 0;
      fmt::print(" | {:>7.0f} {:>6.2f} {:>7.2f} {:>7.4f}", m["quads"].get<double>(),
                 m["mae"].get<double>(), m["psnr"].get<double>(), ssim);
    }
    fmt::print("  {}\n", row.json.value("problems", ""));
  }
}

void print_cost(const std::vector<Row>& rows) {
  std::vector<std::string> stages;
  for (const Row& row : rows) {
    for (const auto& [name, seconds] : row.json["stages"].items()) {
      if (std::ranges::find(stages, name) == stages.end()) stages.push_back(name);
    }
  }
  fmt::print("\n{:{}} {:>9} {:>7} {:>7} {:>7}", "seconds, MB", kNameWidth, "size", "wall", "CPU",
             "peak MB");
  for (const std::string& stage : stages)
    fmt::print(" {:>{}}", stage, std::max<int>(7, stage.size()));
  fmt::print("\n");
  for (const Row& row : rows) {
    const Json& r = row.json;
    const std::string size =
        fmt::format("{:.0f}x{:.0f}", r["width"].get<double>(), r["height"].get<double>());
    fmt::print("{:{}} {:>9} {:>7.2f} {:>7.2f} {:>7.0f}", row.name, kNameWidth, size,
               r["seconds"].get<double>(), r["cpu_seconds"].get<double>(),
               r["peak_mb"].get<double>());
    for (const std::string& stage : stages) {
      fmt::print(" {:>{}.3f}", r["stages"].value(stage, 0.0), std::max<int>(7, stage.size()));
    }
    fmt::print("\n");
  }
}

void print_files(const std::vector<Row>& rows) {
  fmt::print("\n{:{}}", "kilobytes", kNameWidth);
  for (const std::string& ending : kEndings) fmt::print(" {:>9}", ending);
  fmt::print("\n");
  for (const Row& row : rows) {
    fmt::print("{:{}}", row.name, kNameWidth);
    for (const std::string& ending : kEndings) {
      fmt::print(" {:>9.0f}", row.json["files"].value(ending, 0.0) / 1e3);
    }
    fmt::print("\n");
  }
}

/// Returns whether every picture went through.
bool run_folder(const fs::path& folder, const PictureChoice& choice,
                const PictureRunOptions& options) {
  std::vector<Row> rows;
  bool good = true;
  for (const fs::path& picture : pictures_in(folder, choice)) {
    Json json = run_picture(picture, options);
    if (json.contains("error")) {
      fmt::print(stderr, "{}: {}\n", picture.string(), json["error"].get<std::string>());
      good = false;
      continue;
    }
    rows.push_back({picture.stem().string(), std::move(json)});
  }
  if (rows.empty()) return good;
  rows.push_back(mean_row(rows));
  fmt::print("\n{}, {} quads wished, {} pictures\n", folder.string(), options.quads,
             rows.size() - 1);
  print_quality(rows);
  print_cost(rows);
  if (options.files) print_files(rows);
  std::fflush(stdout);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App parser("Quality, time, memory and file sizes over the sample pictures");
  PictureRunOptions options;
  PictureChoice choice;
  bool no_files = false;
  std::vector<std::string> folders;
  parser.add_option("--quads", options.quads, "wished quads")->check(CLI::Range(1, 2'000'000));
  parser.add_option("--threads", options.threads, "worker threads, 0 for all");
  parser.add_option("--only", choice.only, "only pictures whose name has this text");
  parser.add_option("--limit", choice.limit, "at most this many pictures per folder");
  parser.add_flag("--no-files", no_files, "leave the exports out");
  parser.add_option("FOLDERS", folders, "folders to run instead of the usual ones");
  CLI11_PARSE(parser, argc, argv);
  options.files = !no_files;

  bool good = true;
  for (const fs::path& folder : quadrille::bench::picture_folders(folders)) {
    good &= run_folder(folder, choice, options);
  }
  return good ? 0 : 1;
}
