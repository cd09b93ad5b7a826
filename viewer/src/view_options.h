#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "common_options.h"

namespace quadrille::viewer {

/// The command line of `quadrille-view`.
struct ViewOptions {
  std::filesystem::path input, source, screenshot;
  std::string layers;                     ///< empty: the picture
  std::optional<double> zoom;             ///< absent: the picture fits into the window
  std::optional<Eigen::Vector2d> center;  ///< absent: the picture's middle
  Eigen::Array2i size = {1200, 800};
  std::optional<Eigen::Vector2d> pick;  ///< where to click, source pixels; absent: nowhere
  std::optional<double> compare;        ///< share of the window; absent: no comparison
  bool panels = false;                  ///< in the screenshot
  bool timings = false;
  cli::MeshOptions mesh;
  cli::RunOptions run;
};

void declare_view_options(CLI::App& parser, ViewOptions& options);

}  // namespace quadrille::viewer
