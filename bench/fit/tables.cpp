#include "fit/tables.h"

#include <fmt/core.h>

#include <algorithm>

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The means over the rows of the numbers that they have below `place`.
Json mean_figures(const std::string& place, const std::vector<TableRow>& rows) {
  Json result = Json::object();
  for (const TableRow& row : rows) {
    const Json::json_pointer at(place);
    if (!row.json.contains(at)) continue;
    const Json flat = row.json.at(at).flatten();
    for (const auto& [key, value] : flat.items()) {
      if (!value.is_number() || result.contains(key)) continue;
      result[key] = mean(values(rows, {"", place + key}));
    }
  }
  return result.empty() ? result : result.unflatten();
}

/// How many pictures the mesh serves worse than the lattice, and the worst of them.
void print_losses(const FitRun& run, const std::vector<TableRow>& rows) {
  constexpr double kTolerance = 0.05;
  FitRun lattice = run;
  lattice.lattice = true;
  const Json::json_pointer ours(place_of(run) + "/mae"), theirs(place_of(lattice) + "/mae");
  int count = 0, losses = 0;
  double worst = 0;
  std::string name;
  for (const TableRow& row : rows) {
    if (!row.json.contains(ours) || !row.json.contains(theirs)) continue;
    const double excess = row.json.at(ours).get<double>() - row.json.at(theirs).get<double>();
    losses += excess > kTolerance;
    if (count++ == 0 || excess > worst) {
      worst = excess;
      name = row.name;
    }
  }
  if (count == 0) return;
  fmt::print(
      "  {}, {} quads: MAE above the lattice's by more than {} on {} of {}; most {:+.2f}, {}\n",
      run.fit.name, run.quads, kTolerance, losses, count, worst, name);
}

std::vector<int> quad_counts(const std::vector<FitRun>& runs) {
  std::vector<int> counts;
  for (const FitRun& run : runs) {
    if (std::ranges::find(counts, run.quads) == counts.end()) counts.push_back(run.quads);
  }
  return counts;
}

/// A column per figure of the given name that any row has under `at`.
std::vector<Column> member_columns(const std::vector<TableRow>& rows, const std::string& at,
                                   int decimals) {
  std::vector<Column> columns;
  for (const TableRow& row : rows) {
    if (!row.json.contains(Json::json_pointer(at))) continue;
    for (const auto& [name, value] : row.json.at(Json::json_pointer(at)).items()) {
      if (std::ranges::find(columns, name, &Column::title) != columns.end()) continue;
      columns.push_back({name, at + "/" + name, decimals});
    }
  }
  return columns;
}

}  // namespace

std::string place_of(const FitRun& run) {
  return fmt::format("/{}/{}/{}", run.quads, run.mesh_name(), run.fit.name);
}

std::map<std::string, std::vector<TableRow>> by_preset(const std::vector<TableRow>& rows) {
  std::map<std::string, std::vector<TableRow>> kinds;
  for (const TableRow& row : rows) {
    if (row.json.contains("preset")) kinds[row.json["preset"].get<std::string>()].push_back(row);
  }
  return kinds;
}

void print_quality(const std::string& of, const std::vector<FitRun>& runs,
                   const std::vector<TableRow>& rows) {
  for (const int quads : quad_counts(runs)) {
    std::vector<Column> columns;
    for (const FitRun& run : runs) {
      if (run.quads != quads) continue;
      const std::string at = place_of(run);
      columns.push_back(
          {run.mesh_name() + " " + run.fit.name + ": MAE", at + "/mae", 2, 1, Worst::highest});
      columns.push_back({"PSNR", at + "/psnr", 2, 1, Worst::lowest});
      columns.push_back({"SSIM", at + "/ssim", 4, 1, Worst::lowest});
      columns.push_back({"", at + "/fallback"});
    }
    print_table(fmt::format("{} quads wished: {}", quads, of), columns, rows);
  }
}

void print_means(const std::string& of, const std::vector<FitRun>& runs,
                 const std::vector<TableRow>& rows) {
  std::vector<TableRow> means;
  for (const FitRun& run : runs) {
    means.push_back({fmt::format("{} {} {}", run.quads, run.mesh_name(), run.fit.name),
                     mean_figures(place_of(run), rows)});
  }
  std::vector<Column> columns = {{"quads", "/quads"},
                                 {"MAE", "/mae", 2},
                                 {"PSNR", "/psnr", 2},
                                 {"SSIM", "/ssim", 4},
                                 {"scalars", "/scalars"},
                                 {".quad bytes", "/bytes"},
                                 {"per quad", "/bytes_per_quad", 1},
                                 {"JPEG PSNR", "/jpeg/psnr", 2},
                                 {"its bytes", "/jpeg/bytes"},
                                 {"Jacobian 5 %", "/jacobian_p5", 3},
                                 {"folded", "/folded", 2},
                                 {"CPU s", "/cpu", 3},
                                 {"peak MB", "/peak_mb"}};
  std::ranges::copy(member_columns(means, "/iterations", 1), std::back_inserter(columns));
  print_list("Means: " + of, columns, means);
  for (const FitRun& run : runs) {
    if (!run.lattice) print_losses(run, rows);
  }
}

void print_upscale(const std::string& of, const std::vector<TableRow>& rows) {
  std::vector<Column> columns = {{"", "/preset"}, {"quads", "/upscale/quads"}};
  for (const auto& [title, figure, decimals, worst] :
       {std::tuple{"PSNR", "psnr", 2, Worst::lowest},
        {"SSIM", "ssim", 4, Worst::lowest},
        {"edge MAE", "edge_mae", 2, Worst::highest}}) {
    for (const char* method : {"ours", "nearest", "bicubic", "lanczos"}) {
      columns.push_back({fmt::format("{} {}", method, title),
                         fmt::format("/upscale/{}/{}", method, figure), decimals, 1, worst});
    }
  }
  columns.push_back({"dB above Lanczos", "/upscale/gain", 2, 1, Worst::lowest});
  columns.push_back({"edge MAE over its", "/upscale/edge_ratio", 3, 1, Worst::highest});
  print_table("Reduced by 4 and enlarged again: " + of, columns, rows);
  std::vector<TableRow> means;
  for (const auto& [kind, members] : by_preset(rows)) {
    means.push_back({kind, {{"upscale", mean_figures("/upscale", members)}}});
  }
  if (means.size() > 1) print_list("The same by kind of picture", columns, means);
}

void print_size_growth(const std::string& of, const std::vector<TableRow>& rows) {
  std::vector<Column> columns = {{"size", "/size"}, {"quads", "/quads"}};
  std::ranges::copy(member_columns(rows, "/iterations", 0), std::back_inserter(columns));
  columns.push_back({"CPU s", "/cpu", 2});
  columns.push_back({"peak MB", "/peak_mb"});
  columns.push_back({"", "/error"});
  print_list("Iterations against the picture's size: " + of, columns, rows);
}

}  // namespace quadrille::bench
