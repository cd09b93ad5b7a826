#include "tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The members that any row has at `at`, in the order in which they first appear.
std::vector<std::string> members(const std::vector<TableRow>& rows, const std::string& at) {
  const Json::json_pointer pointer(at);
  std::vector<std::string> names;
  for (const TableRow& row : rows) {
    if (!row.json.contains(pointer) || !row.json.at(pointer).is_object()) continue;
    for (const auto& [name, value] : row.json.at(pointer).items()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// On how many rows the first figure is below the second.
void print_share_below(const std::vector<TableRow>& rows, const std::string& first,
                       const std::string& second, const std::string& what) {
  const Json::json_pointer a(first), b(second);
  int lower = 0, count = 0;
  for (const TableRow& row : rows) {
    if (!row.json.contains(a) || !row.json.contains(b)) continue;
    ++count;
    lower += row.json.at(a).get<double>() < row.json.at(b).get<double>();
  }
  if (count) fmt::print("  {} on {} of {} ({:.0f} %)\n", what, lower, count, 100.0 * lower / count);
}

/// The mean singularities of one phase of the field over those of the others.
void print_ratios(const std::vector<TableRow>& rows, const std::string& at,
                  const std::string& phase) {
  const auto mean_of = [&](const std::string& which, const char* figure) {
    return mean(values(rows, {"", at + "/" + which + "/" + figure}));
  };
  const double ours = mean_of(phase, "singularities");
  for (const std::string& other : members(rows, at)) {
    if (other == phase) continue;
    fmt::print("  {} / {}: {:.3f}", phase, other, ours / mean_of(other, "singularities"));
    const double alignment = mean_of(other, "alignment");
    if (std::isfinite(alignment)) {
      fmt::print(" at {:+.2f} degrees, alignment {:.2f}",
                 mean_of(other, "misalignment") - mean_of(phase, "misalignment"), alignment);
    }
    fmt::print("\n");
  }
}

std::vector<Column> with_stages(std::vector<Column> columns, const std::vector<TableRow>& rows,
                                const std::string& front) {
  for (const std::string& stage : members(rows, front + "/stages")) {
    columns.push_back({stage, front + "/stages/" + stage, 3, 1, Worst::highest});
  }
  columns.push_back({"total", front + "/cpu", 3, 1, Worst::highest});
  columns.push_back({"x reference", front + "/ratio", 2, 1, Worst::highest});
  return columns;
}

/// The mean over the pictures of what they have at one wished number of cells.
TableRow mean_at(const std::vector<TableRow>& rows, std::size_t index, int wished) {
  TableRow result{fmt::format("{} cells", wished), Json::object()};
  const std::string at = fmt::format("/recall/{}", index);
  for (const std::string& method : members(rows, at)) {
    for (const std::string& figure : members(rows, at + "/" + method)) {
      result.json[method][figure] = mean(values(rows, {"", at + "/" + method + "/" + figure}));
    }
  }
  return result;
}

std::vector<Column> recall_columns(const std::string& at) {
  std::vector<Column> columns = {{"our cells", at + "/ours/cells"}};
  const auto add = [&](const std::string& title, const std::string& member, bool cells) {
    if (cells) columns.push_back({"cells", at + "/" + member + "/cells"});
    columns.push_back({title, at + "/" + member + "/recall", 1, 100, Worst::lowest});
    columns.push_back({"density", at + "/" + member + "/density", 1, 100, Worst::highest});
  };
  add("ours", "ours", false);
  add("grid", "grid", false);
  add("SLIC, our cells", "slic", false);
  add("SLIC, our density", "slic_density", true);
  add("best SLIC, our density", "slic_best", true);
  return columns;
}

}  // namespace

void print_fields(const std::string& of, const std::vector<TableRow>& rows) {
  const std::string at = "/fields/phases";
  std::vector<Column> columns;
  for (const std::string& phase : members(rows, at)) {
    columns.push_back({phase, at + "/" + phase + "/singularities", 1, 1, Worst::highest});
    columns.push_back({"degrees", at + "/" + phase + "/misalignment", 2, 1, Worst::highest});
    columns.push_back({"energy", at + "/" + phase + "/energy", 0, 1, Worst::highest});
  }
  print_table("Singularities of the cross field, its misalignment and energy: " + of, columns,
              rows);
  print_ratios(rows, at, "cancelled");
}

void print_cost(const std::string& of, const std::vector<TableRow>& rows) {
  std::vector<Column> columns = {{"width", "/front/width"},
                                 {"height", "/front/height"},
                                 {"quads", "/front/quads"},
                                 {"off %", "/front/count_error", 1, 100}};
  columns = with_stages(std::move(columns), rows, "/front");
  columns.push_back({"x 0.1", "/baseline/ratio_change", 2, 1, Worst::highest});
  columns.push_back({"", "/front/fallback"});
  print_table("CPU seconds of the front half: " + of, columns, rows);
}

void print_shape(const std::string& of, const std::vector<TableRow>& rows) {
  print_table("Shape of the quads: " + of,
              {{"Jacobian min", "/shape/jacobian_min", 3, 1, Worst::lowest},
               {"in 0.1", "/baseline/jacobian_min", 3, 1, Worst::lowest},
               {"5 %", "/shape/jacobian_p5", 3, 1, Worst::lowest},
               {"mean", "/shape/jacobian_mean", 3, 1, Worst::lowest},
               {"irregular %", "/shape/irregular", 1, 100, Worst::highest},
               {"in 0.1", "/baseline/irregular", 1, 100, Worst::highest},
               {"anisotropy", "/shape/anisotropy_mean", 2, 1, Worst::highest},
               {"max", "/shape/anisotropy_max", 1, 1, Worst::highest},
               {"aligned %", "/shape/aligned", 1, 100, Worst::lowest}},
              rows);
}

void print_fit(const std::string& of, const std::vector<TableRow>& rows) {
  print_table("The picture from fitted patches: " + of,
              {{"quads", "/ours/quads"},
               {"MAE", "/ours/mae", 2, 1, Worst::highest},
               {"PSNR", "/ours/psnr", 2, 1, Worst::lowest},
               {"MAE in 0.1", "/baseline/mae", 2, 1, Worst::highest},
               {"quads", "/lattice/quads"},
               {"lattice MAE", "/lattice/mae", 2, 1, Worst::highest},
               {"PSNR", "/lattice/psnr", 2, 1, Worst::lowest}},
              rows);
  print_share_below(rows, "/ours/mae", "/baseline/mae", "MAE below version 0.1's");
  print_share_below(rows, "/ours/mae", "/lattice/mae", "MAE below the lattice's");
}

void print_growth(const std::string& of, const std::vector<TableRow>& rows) {
  std::vector<Column> columns = {
      {"size", "/size"}, {"quads", "/quads"}, {"off %", "/count_error", 1, 100}};
  columns = with_stages(std::move(columns), rows, "");
  columns.push_back({"ms/1000 quads", "/ms_per_1000_quads", 1});
  columns.push_back({"us/pixel", "/us_per_pixel", 2});
  columns.push_back({"peak MB", "/peak_mb"});
  columns.push_back({"", "/fallback"});
  columns.push_back({"", "/error"});
  print_list("CPU seconds of the front half: " + of, columns, rows);
}

void print_recall(const std::string& of, const std::vector<TableRow>& rows) {
  std::vector<TableRow> means;
  const Json& first = rows.front().json.at("recall");
  for (std::size_t i = 0; i < first.size(); ++i) {
    const int wished = first[i].at("wished").get<int>();
    const std::string at = fmt::format("/recall/{}", i);
    print_table(fmt::format("Boundary recall in per cent at about {} cells: {}", wished, of),
                recall_columns(at), rows);
    print_share_below(rows, at + "/slic_density/recall", at + "/ours/recall",
                      "recall above SLIC's at equal density");
    means.push_back(mean_at(rows, i, wished));
  }
  print_list("Boundary recall in per cent, mean over pictures: " + of, recall_columns(""), means);
}

}  // namespace quadrille::bench
