#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace quadrille::bench {

struct PictureRunOptions {
  int quads = 3000;
  int threads = 0;
  bool files = true;  ///< also export, for the sizes
};

/// Vectorizes a picture by each method in a process of its own, so that the peak memory is this
/// picture's, and returns what it measured:
/// width, height, `seconds` and `cpu_seconds` of reading, vectorizing and drawing at 1x, `peak_mb`
/// of these, `stages` (name to seconds), `problems` (folded patches, uncovered pixels, ...), per
/// method in `hermite`, `bessel`, `lattice`: quads, mae, psnr, ssim; and `files` (ending to bytes).
/// On failure: `error` and nothing else.
nlohmann::ordered_json run_picture(const std::filesystem::path& picture,
                                   const PictureRunOptions& options);

}  // namespace quadrille::bench
