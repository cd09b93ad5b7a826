#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace quadrille::bench {

struct PictureOptions {
  int quads = 3000;
  int threads = 0;
};

/// Everything but recall that is measured on one picture: `front` (see FrontHalf), `fields` (see
/// field_figures()), `shape` (ShapeStatistics, aligned), and `ours` and `lattice`, each with quads,
/// mae and psnr of the fitted patches drawn at 1x.
nlohmann::ordered_json picture_figures(const std::filesystem::path& picture,
                                       const PictureOptions& options);

}  // namespace quadrille::bench
