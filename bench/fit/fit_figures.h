#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "fit/methods.h"

namespace quadrille::bench {

struct FitFigureOptions {
  int threads = 0;
  bool jpeg = true;  ///< also search the JPEG of equal size
};

/// Takes a picture from its file to a document in a process of its own: width, height, cpu (seconds
/// of reading, vectorizing and encoding), peak_mb of these, quads, scalars (numbers that determine
/// the patches), bytes of the document, bytes_per_quad, iterations (see solve_iterations()), mae,
/// psnr and ssim of the decoded document drawn at 1x, jacobian_min and jacobian_p5 of the mesh,
/// valence (largest), folded, fallback (a word, when it fell back), and jpeg (see jpeg_within()).
/// On failure: `error` and nothing else.
nlohmann::ordered_json fit_figures(const std::filesystem::path& picture, const FitRun& run,
                                   const FitFigureOptions& options);

/// The figures of the stages whose names speak of iterations or rounds, summed by name.
nlohmann::ordered_json solve_iterations(const VectorizeReport& report);

}  // namespace quadrille::bench
