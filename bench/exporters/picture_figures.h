#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "exporters/drawing_program.h"
#include "exporters/outputs.h"

namespace quadrille::bench {

struct ExporterRun {
  int quads = 3000;
  int threads = 0;
  std::vector<Output> outputs;
  std::vector<DrawingProgram> programs;
};

/// Scales that files are drawn at.
inline constexpr int kDrawingScales[] = {1, 4};

/// Vectorizes a picture, writes all outputs and lets the programs draw them, in a process of its
/// own. Returns width, height, quads, and `outputs`: by name `bytes`, `gzip`, and `programs`: by
/// name `source_psnr` (dB of the drawing at 1x over the picture) and per scale `psnr`, `edge_mae`,
/// leaks (see drawing_figures()), `cpu` and `seconds`. The reference is our own rendering of the
/// document; for other programs' files resvg's drawing, which itself then has no such figures. A
/// program that fails leaves `error`. On other failures: `error` and nothing else.
nlohmann::ordered_json exporter_figures(const std::filesystem::path& picture,
                                        const ExporterRun& run);

}  // namespace quadrille::bench
