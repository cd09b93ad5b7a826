#pragma once

#include <CLI/CLI.hpp>

#include "quadrille/export.h"

namespace quadrille::cli {

/// What outputs of any format are written with: --scale, --lossless, --svg-level, --svg-size-limit,
/// --dpi and those of gltf_options.h. A size limit at the level inkscape is a wrong command line.
void declare_export_options(CLI::App& parser, ExportOptions& options);

}  // namespace quadrille::cli
