#include "exporters/tables.h"

#include <fmt/core.h>

#include <algorithm>

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// A program draws a file at once when it takes no longer, in CPU seconds.
constexpr double kAtOnce = 1;

std::string place_of(const Output& output) { return "/outputs/" + output.name; }
std::string place_of(const Output& output, const std::string& program) {
  return place_of(output) + "/programs/" + program;
}

/// The programs that drew the output, in the order of its list.
std::vector<std::string> programs_of(const Output& output, const std::vector<TableRow>& rows) {
  std::vector<std::string> names;
  for (const std::string& program : output.programs) {
    const Json::json_pointer at(place_of(output, program));
    if (std::ranges::any_of(rows, [&](const TableRow& row) { return row.json.contains(at); })) {
      names.push_back(program);
    }
  }
  return names;
}

/// Means, and with `worst` the worst value, of the rows' numbers at `at`, into `figures`.
void summarise(Json& figures, const std::string& name, const std::vector<TableRow>& rows,
               const std::string& at, Worst worst = Worst::none) {
  const std::vector<double> numbers = values(rows, {"", at});
  if (numbers.empty()) return;
  figures[name] = mean(numbers);
  if (worst == Worst::lowest) figures["worst_" + name] = std::ranges::min(numbers);
  if (worst == Worst::highest) figures["worst_" + name] = std::ranges::max(numbers);
}

Json summary_of(const Output& output, const std::string& program,
                const std::vector<TableRow>& rows) {
  const std::string at = place_of(output, program);
  Json figures = Json::object();
  summarise(figures, "bytes", rows, place_of(output) + "/bytes");
  summarise(figures, "gzip", rows, place_of(output) + "/gzip", Worst::highest);
  summarise(figures, "source", rows, at + "/source_psnr");
  for (const int scale : kDrawingScales) {
    const std::string of = std::to_string(scale), in = at + "/" + of + "/";
    summarise(figures, "psnr" + of, rows, in + "psnr", Worst::lowest);
    summarise(figures, "leak" + of, rows, in + "leak_mean");
    summarise(figures, "leak_max" + of, rows, in + "leak_max", Worst::highest);
    summarise(figures, "border_max" + of, rows, in + "border_max", Worst::highest);
    summarise(figures, "edge" + of, rows, in + "edge_mae", Worst::highest);
    summarise(figures, "cpu" + of, rows, in + "cpu", Worst::highest);
  }
  const std::vector<double> cpu = values(rows, {"", at + "/1/cpu"});
  figures["at_once"] = fmt::format(
      "{} of {}", std::ranges::count_if(cpu, [](double s) { return s <= kAtOnce; }), rows.size());
  return figures;
}

}  // namespace

void print_outputs(const std::string& of, const ExporterRun& run,
                   const std::vector<TableRow>& rows) {
  for (const Output& output : run.outputs) {
    std::vector<Column> columns = {
        {"KB", place_of(output) + "/bytes", 1, 1e-3, Worst::highest},
        {"gzip KB", place_of(output) + "/gzip", 1, 1e-3, Worst::highest}};
    for (const std::string& program : programs_of(output, rows)) {
      const std::string at = place_of(output, program);
      columns.push_back({program + ": over picture", at + "/source_psnr", 1, 1, Worst::lowest});
      columns.push_back({"dB 1x", at + "/1/psnr", 1, 1, Worst::lowest});
      columns.push_back({"4x", at + "/4/psnr", 1, 1, Worst::lowest});
      columns.push_back({"leak", at + "/1/leak_mean", 3, 1, Worst::highest});
      columns.push_back({"edge MAE", at + "/1/edge_mae", 2, 1, Worst::highest});
      columns.push_back({"CPU s", at + "/1/cpu", 2, 1, Worst::highest});
      columns.push_back({"", at + "/error"});
    }
    print_table(output.name + ": " + of, columns, rows);
  }
}

void print_programs(const std::string& of, const ExporterRun& run,
                    const std::vector<TableRow>& rows) {
  std::vector<TableRow> means;
  for (const Output& output : run.outputs) {
    for (const std::string& program : programs_of(output, rows)) {
      means.push_back({output.name + ", " + program, summary_of(output, program, rows)});
    }
  }
  const std::vector<Column> columns = {{"KB", "/bytes", 1, 1e-3},
                                       {"gzip KB", "/gzip", 1, 1e-3},
                                       {"worst", "/worst_gzip", 1, 1e-3},
                                       {"dB 1x", "/psnr1", 1},
                                       {"worst", "/worst_psnr1", 1},
                                       {"dB 4x", "/psnr4", 1},
                                       {"worst", "/worst_psnr4", 1},
                                       {"over picture", "/source", 1},
                                       {"leak 1x", "/leak1", 3},
                                       {"most", "/worst_leak_max1"},
                                       {"at border", "/worst_border_max1"},
                                       {"leak 4x", "/leak4", 3},
                                       {"most", "/worst_leak_max4"},
                                       {"at border", "/worst_border_max4"},
                                       {"edge MAE 1x", "/edge1", 2},
                                       {"worst", "/worst_edge1", 2},
                                       {"4x", "/edge4", 2},
                                       {"worst", "/worst_edge4", 2},
                                       {"CPU s 1x", "/cpu1", 2},
                                       {"worst", "/worst_cpu1", 2},
                                       {"4x", "/cpu4", 2},
                                       {"within 1 s", "/at_once"}};
  print_list("Means: " + of, columns, means);
}

}  // namespace quadrille::bench
