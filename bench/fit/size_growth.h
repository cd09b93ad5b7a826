#pragma once

#include <filesystem>
#include <vector>

#include "table.h"

namespace quadrille::bench {

/// Vectorizes the picture at 1, 2 and 4 times its side, once with the same number of quads and once
/// with as many pixels per quad, each in a process of its own. A row has size (WxH), quads, cpu,
/// peak_mb and iterations (see solve_iterations()); or error and nothing else.
std::vector<TableRow> iterations_with_size(const std::filesystem::path& picture, int quads,
                                           int threads);

}  // namespace quadrille::bench
