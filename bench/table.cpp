#include "table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<std::string>;

const Json* find(const TableRow& row, const Column& column) {
  const Json::json_pointer at(column.at);
  return row.json.contains(at) ? &row.json.at(at) : nullptr;
}

std::string text_of(double value, const Column& column) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, column.decimals) : "-";
}

std::string text_of(const TableRow& row, const Column& column) {
  const Json* value = find(row, column);
  if (value && value->is_string()) return value->get<std::string>();
  if (value && value->is_number()) return text_of(column.factor * value->get<double>(), column);
  return "-";
}

std::string worst_text(const std::vector<TableRow>& rows, const Column& column) {
  const std::vector<double> numbers = values(rows, column);
  if (numbers.empty() || column.worst == Worst::none) return "";
  const auto [low, high] = std::ranges::minmax(numbers);
  return text_of(column.worst == Worst::lowest ? low : high, column);
}

void print_lines(const std::string& title, const std::vector<Cells>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const Cells& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  fmt::print("\n{}\n", title);
  for (const Cells& line : lines) {
    fmt::print("  {:<{}}", line.front(), widths.front());
    for (std::size_t i = 1; i < line.size(); ++i) fmt::print("  {:>{}}", line[i], widths[i]);
    fmt::print("\n");
  }
  std::fflush(stdout);
}

std::vector<Column> used_columns(const std::vector<Column>& columns,
                                 const std::vector<TableRow>& rows) {
  std::vector<Column> used;
  std::ranges::copy_if(columns, std::back_inserter(used), [&](const Column& column) {
    return std::ranges::any_of(rows, [&](const TableRow& row) { return find(row, column); });
  });
  return used;
}

/// A line whose cells are made from the columns.
template <class Cell>
Cells line_of(const std::string& name, const std::vector<Column>& columns, const Cell& cell) {
  Cells line = {name};
  for (const Column& column : columns) line.push_back(cell(column));
  return line;
}

std::vector<Cells> lines_of(const std::vector<Column>& columns, const std::vector<TableRow>& rows) {
  std::vector<Cells> lines = {
      line_of("", columns, [](const Column& column) { return column.title; })};
  for (const TableRow& row : rows) {
    lines.push_back(
        line_of(row.name, columns, [&](const Column& column) { return text_of(row, column); }));
  }
  return lines;
}

}  // namespace

Json as_json(const std::vector<TableRow>& rows) {
  Json entries = Json::object();
  for (const TableRow& row : rows) entries[row.name] = row.json;
  return entries;
}

std::vector<double> values(const std::vector<TableRow>& rows, const Column& column) {
  std::vector<double> numbers;
  for (const TableRow& row : rows) {
    const Json* value = find(row, column);
    if (value && value->is_number()) numbers.push_back(column.factor * value->get<double>());
  }
  return numbers;
}

double mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

void print_table(const std::string& title, const std::vector<Column>& columns,
                 const std::vector<TableRow>& rows) {
  const std::vector<Column> used = used_columns(columns, rows);
  std::vector<Cells> lines = lines_of(used, rows);
  lines.push_back(line_of("mean", used, [&](const Column& column) {
    const std::vector<double> numbers = values(rows, column);
    return numbers.empty() ? std::string() : text_of(mean(numbers), column);
  }));
  lines.push_back(
      line_of("worst", used, [&](const Column& column) { return worst_text(rows, column); }));
  print_lines(title, lines);
}

void print_list(const std::string& title, const std::vector<Column>& columns,
                const std::vector<TableRow>& rows) {
  print_lines(title, lines_of(used_columns(columns, rows), rows));
}

}  // namespace quadrille::bench
