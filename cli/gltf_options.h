#pragma once

#include <CLI/CLI.hpp>

#include "quadrille/export.h"

namespace quadrille::cli {

/// What decides about .glb and .gltf files.
void declare_gltf_options(CLI::App& parser, GltfOptions& options);

}  // namespace quadrille::cli
