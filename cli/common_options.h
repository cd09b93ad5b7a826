#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "observer.h"
#include "quadrille/document.h"
#include "quadrille/vectorize.h"

namespace quadrille::cli {

inline constexpr int kMaxQuads = 2'000'000;

/// Options that several sub-commands share, and their declaration.

struct RunOptions {
  int threads = 0;
  bool verbose = false;
  bool quiet = false;

  Verbosity verbosity() const;
};
void declare_run_options(CLI::App& parser, RunOptions& options);

struct MeshOptions {
  int quads = 3000;
  std::string fit = "hermite";
  bool lattice = false;
  std::string mesh = "whole";
  double alignment = CrossFieldOptions{}.alignment;
  std::string field = "smooth";
  std::filesystem::path density;  ///< empty for none

  /// Reads the density map.
  VectorizeOptions vectorize_options() const;
};
/// --quads, --lattice, --mesh, --alignment, --field and --density.
void declare_quad_options(CLI::App& parser, MeshOptions& options);
/// These and --fit.
void declare_mesh_options(CLI::App& parser, MeshOptions& options);

void declare_input(CLI::App& parser, std::filesystem::path& input, const std::string& what);

/// `-o`, once per file.
void declare_outputs(CLI::App& parser, std::vector<std::filesystem::path>& outputs);
/// `-o`, exactly once.
void declare_output(CLI::App& parser, std::filesystem::path& output);

/// --lossless, for `.quad` outputs.
void declare_document_options(CLI::App& parser, DocumentOptions& options);

/// Accepts finite numbers above 0.
CLI::Validator positive_number();

}  // namespace quadrille::cli
