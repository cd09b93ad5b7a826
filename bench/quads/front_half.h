#pragma once

#include <nlohmann/json.hpp>

#include "quadrille/vectorize.h"

namespace quadrille::bench {

/// A quadrangulation and what it cost.
struct FrontHalf {
  Quadrangulation quads;
  /// width, height, wished, quads, count_error (relative), fallback (a word, when it fell back),
  /// stages (name to CPU seconds, `rest` for what no stage reports), cpu (their sum), ratio (cpu
  /// over reference_work_seconds() in the same process).
  nlohmann::ordered_json figures;
};

struct FrontHalfOptions {
  int quads = 3000;
  int threads = 0;
  int runs = 1;  ///< the quickest counts
};

FrontHalf measure_front_half(const Raster& picture, const FrontHalfOptions& options);

}  // namespace quadrille::bench
