#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "observer.h"
#include "quadrille/vectorize.h"

namespace quadrille::cli {

/// Options that several sub-commands share, and their declaration.

struct RunOptions {
  int threads = 0;
  bool verbose = false;
  bool quiet = false;

  Verbosity verbosity() const;
};
void declare_run_options(CLI::App& parser, RunOptions& options);

struct MeshOptions {
  std::string preset = "auto";
  std::optional<int> quads;  ///< absent: the preset's
  std::string fit = "hermite";
  std::string tears;  ///< empty: the preset decides
  int optimize = OptimizeOptions{}.rounds;
  bool editable = false;
  bool lattice = false;
  std::string mesh = "whole";
  double alignment = CrossFieldOptions{}.alignment;
  std::string field = "smooth";
  std::filesystem::path density;  ///< empty for none

  bool operator==(const MeshOptions&) const = default;
};
/// --preset, --quads, --lattice, --mesh, --alignment, --field and --density.
void declare_quad_options(CLI::App& parser, MeshOptions& options);
/// These, --fit, --optimize and --editable.
void declare_mesh_options(CLI::App& parser, MeshOptions& options);

void declare_input(CLI::App& parser, std::filesystem::path& input, const std::string& what);

/// `-o`, once per file.
void declare_outputs(CLI::App& parser, std::vector<std::filesystem::path>& outputs);
/// `-o`, exactly once, for `what`.
void declare_output(CLI::App& parser, std::filesystem::path& output,
                    const std::string& what = "picture");

/// Accepts finite numbers above 0.
CLI::Validator positive_number();
/// Refuses the empty name, which scripts pass for variables that are not set.
CLI::Validator file_name();

/// Accepts numbers from low to high; other than CLI::Range, no NaN.
CLI::Validator number_from(double low, double high);

/// Accepts whole numbers from low to high in decimal digits.
CLI::Validator whole_number_from(int low, int high);

}  // namespace quadrille::cli
