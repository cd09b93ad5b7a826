#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quadrille::bench {

/// One printed line: a name and figures to pick from.
struct TableRow {
  std::string name;
  nlohmann::ordered_json json;
};

/// The rows' figures by their names.
nlohmann::ordered_json as_json(const std::vector<TableRow>& rows);

/// Which end of a column's values is the bad one.
enum class Worst { none, lowest, highest };

struct Column {
  std::string title;
  std::string at;     ///< JSON pointer into the rows; a row without it shows a dash
  int decimals = 0;   ///< digits after the point
  double factor = 1;  ///< that the value is multiplied by, such as 100 for per cent
  Worst worst = Worst::none;
};

/// The column's numbers over the rows that have one.
std::vector<double> values(const std::vector<TableRow>& rows, const Column& column);

/// Mean of the numbers; NaN when there are none.
double mean(const std::vector<double>& numbers);

/// Prints a line per row, then their mean, and the worst where a column says which that is.
/// Columns without any value are left out; strings are shown as they are.
void print_table(const std::string& title, const std::vector<Column>& columns,
                 const std::vector<TableRow>& rows);

/// The same without mean and worst: for rows that do not belong to one population.
void print_list(const std::string& title, const std::vector<Column>& columns,
                const std::vector<TableRow>& rows);

}  // namespace quadrille::bench
