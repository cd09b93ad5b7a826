#pragma once

#include <vector>

#include "quadrille/vectorize.h"

namespace quadrille {

struct ErrorBound {
  /// Wished mean absolute error of the picture drawn at scale 1, as compare() has it: in (0, 255].
  double mae = 5;
  /// No round asks for more quads, 1 to kMaxQuads; 0 for a quad per 4 pixels, at most 200,000.
  int max_quads = 0;
  /// No more vectorizations than this, >= 1; three or four reach most bounds.
  int max_rounds = 8;
};

struct ErrorBoundRound {
  int wished_quads = 0, quads = 0;
  double mae = 0;
};

struct BoundedVectorization {
  /// Of the rounds that keep within the bound, the one with the fewest quads asked for; when none
  /// does, the one with the least error.
  Vectorization result;
  double mae = 0;    ///< of that result
  bool met = false;  ///< mae <= the bound
  std::vector<ErrorBoundRound> rounds;
};

/// Searches the number of quads that the picture takes for the wished error, starting at
/// options.quads: the error falls about as a power of the number, so each round steps on the
/// logarithms of both, between the rounds above and below the bound. Ends when the error is between
/// 95 and 100 % of the bound, when the neighbouring numbers are within 5 %, or at a limit: an
/// unreachable bound is no error here, look at `met`. Reports a stage "error bound" per round.
/// Throws Error{invalid_argument} for a bound out of range, and as vectorize() does.
BoundedVectorization vectorize_to_error(const Raster& picture, const ErrorBound& bound,
                                        const VectorizeOptions& options = {},
                                        const RunContext& context = {});

}  // namespace quadrille
