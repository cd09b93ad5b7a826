#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quadrille::bench {

/// A program that draws files, with what it needs: commands on PATH and packages of npm in
/// bench/programs.
struct DrawingProgram {
  std::string name;
  std::vector<std::string> commands;
  std::vector<std::string> modules;
};

bool is_available(const DrawingProgram& program);

const std::vector<DrawingProgram>& drawing_programs();

/// A file to draw at `scale` as a PNG of width x height pixels.
struct DrawingJob {
  std::filesystem::path file, picture;
  int width = 0, height = 0;
  double scale = 1;
};

/// Draws the files one after another; per job `cpu` and `seconds` of the drawing, the program's
/// start included where it is no library or browser, or `error`. Throws Error{io_failure} when the
/// program cannot be started.
std::vector<nlohmann::ordered_json> draw(const DrawingProgram& program,
                                         const std::vector<DrawingJob>& jobs,
                                         const std::filesystem::path& scratch_folder);

/// Path of a script in bench/programs.
std::string script(const std::string& name);

/// True when the package of npm is installed in bench/programs.
bool has_module(const std::string& name);

}  // namespace quadrille::bench
