#pragma once

#include <filesystem>
#include <vector>

#include "table.h"

namespace quadrille::bench {

/// Adds to the rows that the file knows by name a member `baseline`: the stored figures and
/// `ratio_change`, today's cost over the stored one. Does nothing when the file was written for
/// another number of quads. Throws Error{io_failure} when it cannot be read.
void add_baseline(std::vector<TableRow>& rows, const std::filesystem::path& file, int quads);

/// Stores quads, mae, irregular, jacobian_min and ratio (see FrontHalf) of every row.
void write_baseline(const std::vector<TableRow>& rows, const std::filesystem::path& file,
                    int quads);

}  // namespace quadrille::bench
