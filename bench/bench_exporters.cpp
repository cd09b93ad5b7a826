// How faithful, small and quick to draw the exported files are in the programs that people open
// them with, beside tracers on the same pictures, as tables.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "exporters/picture_figures.h"
#include "exporters/tables.h"
#include "pictures.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;
using namespace quadrille::bench;
using Json = nlohmann::ordered_json;

struct Options {
  PictureChoice choice;
  ExporterRun run;
  std::vector<std::string> outputs;
  std::string json_file;
  std::vector<std::string> inputs;
};

/// The available ones of the list; says which are not.
template <class T>
std::vector<T> available(const std::vector<T>& list, const char* what) {
  std::vector<T> found;
  for (const T& one : list) {
    if (is_available(one)) {
      found.push_back(one);
    } else {
      fmt::print("{}: no such {} here, skipped\n", one.name, what);
    }
  }
  return found;
}

std::vector<Output> wished_outputs(const std::vector<std::string>& names) {
  std::vector<Output> wished;
  for (const Output& output : all_outputs()) {
    const bool is_wished = names.empty() || std::ranges::any_of(names, [&](const auto& name) {
                             return output.name.find(name) != std::string::npos;
                           });
    if (is_wished) wished.push_back(output);
  }
  return available(wished, "format, level or tracer");
}

/// Pictures in the folders and files named.
std::vector<fs::path> pictures_of(const Options& options) {
  std::vector<fs::path> pictures;
  for (const std::string& input : options.inputs) {
    if (fs::is_directory(input)) {
      const std::vector<fs::path> more = pictures_in(input, options.choice);
      pictures.insert(pictures.end(), more.begin(), more.end());
    } else {
      pictures.emplace_back(input);
    }
  }
  return pictures;
}

bool run(Options& options) {
  options.run.outputs = wished_outputs(options.outputs);
  options.run.programs = available(drawing_programs(), "program");
  bool good = true;
  std::vector<TableRow> rows;
  for (const fs::path& picture : pictures_of(options)) {
    Json figures = exporter_figures(picture, options.run);
    if (figures.contains("error")) {
      fmt::print(stderr, "{}: {}\n", picture.string(), figures["error"].get<std::string>());
      good = false;
    } else {
      rows.push_back({picture.stem().string(), std::move(figures)});
      // A run takes long: what there is so far can be looked at.
      good &= write_json(as_json(rows), options.json_file);
      fmt::print(stderr, "{}\n", picture.string());
    }
  }
  if (rows.empty()) return false;
  const std::string of =
      fmt::format("{} pictures, {} quads wished", rows.size(), options.run.quads);
  print_outputs(of, options.run, rows);
  print_programs(of, options.run, rows);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App parser("Exported files in the programs of others");
  Options options;
  options.inputs = {(fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures").string()};
  parser.add_option("--quads", options.run.quads, "wished quads")->check(CLI::Range(1, 2'000'000));
  parser.add_option("--threads", options.run.threads, "worker threads, 0 for all");
  parser.add_option("--only", options.choice.only, "only pictures whose name has this text");
  parser.add_option("--limit", options.choice.limit, "at most this many pictures per folder");
  parser
      .add_option("--outputs", options.outputs,
                  "only formats, levels and tracers whose name has one of these texts")
      ->delimiter(',');
  parser.add_option("--json", options.json_file, "also write all figures to this file");
  parser.add_option("INPUTS", options.inputs, "pictures or folders instead of the samples");
  CLI11_PARSE(parser, argc, argv);
  return exit_code([&] { return run(options); });
}
