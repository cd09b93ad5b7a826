#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace quadrille::bench {

struct RecallOptions {
  bool slic = true;
  int threads = 0;
};

/// Boundary recall (paper, Fig. 12) of a picture whose drawings are in the folder: one element per
/// wished number of cells, with `wished`, and `ours`, `grid` (as many squares), `slic` (as many
/// cells, recommended compactness), `slic_density` (our boundary density, recommended compactness),
/// `slic_best` (our density, the compactness that serves SLIC best), each {cells, recall, density}.
/// The members of SLIC are missing when it is not wanted or not built.
nlohmann::ordered_json recall_figures(const std::filesystem::path& picture,
                                      const std::filesystem::path& drawings,
                                      const RecallOptions& options);

}  // namespace quadrille::bench
