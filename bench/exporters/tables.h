#pragma once

#include <string>
#include <vector>

#include "exporters/picture_figures.h"
#include "table.h"

namespace quadrille::bench {

/// A table per output: sizes and, program by program, how near its drawing is, a line per picture.
void print_outputs(const std::string& of, const ExporterRun& run,
                   const std::vector<TableRow>& rows);

/// A line per output and program: means over the pictures and the worst of them.
void print_programs(const std::string& of, const ExporterRun& run,
                    const std::vector<TableRow>& rows);

}  // namespace quadrille::bench
