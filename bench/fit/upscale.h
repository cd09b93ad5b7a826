#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace quadrille::bench {

struct UpscaleOptions {
  int quads = 0;             ///< of drawings; 0: as many as their preset gives the small picture
  int photo_quads = 16'000;  ///< where choose_preset() takes the original for a photograph
  int threads = 0;
};

/// Reduces a picture to a quarter of its sides (cut to multiples of 4), enlarges that again in
/// several ways and compares with the original, in a process of its own. `ours` vectorizes the
/// small picture and draws it at scale 4; `nearest`, `bicubic` and `lanczos` resample it (see
/// enlarged()). Each has psnr, ssim, mae and edge_mae (see edge_error()). Besides: quads, gain (dB
/// of ours above lanczos) and edge_ratio (edge_mae of ours over that of lanczos). On failure:
/// `error` and nothing else.
nlohmann::ordered_json upscale_figures(const std::filesystem::path& picture,
                                       const UpscaleOptions& options);

}  // namespace quadrille::bench
