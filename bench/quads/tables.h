#pragma once

#include <string>
#include <vector>

#include "table.h"

namespace quadrille::bench {

/// Each prints one table of the rows that picture_figures(), growth_*() and recall_figures() give.

void print_fields(const std::string& of, const std::vector<TableRow>& rows);
void print_cost(const std::string& of, const std::vector<TableRow>& rows);
void print_shape(const std::string& of, const std::vector<TableRow>& rows);
void print_fit(const std::string& of, const std::vector<TableRow>& rows);
void print_growth(const std::string& of, const std::vector<TableRow>& rows);
/// The rows' member `recall`.
void print_recall(const std::string& of, const std::vector<TableRow>& rows);

}  // namespace quadrille::bench
