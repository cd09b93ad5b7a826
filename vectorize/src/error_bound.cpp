#include "quadrille/error_bound.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "error_search.h"
#include "quadrille/error.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

constexpr double kLeastPixelsPerQuad = 4;
constexpr double kUsualCeiling = 200'000;

void check(const ErrorBound& bound) {
  if (!(bound.mae > 0 && bound.mae <= 255)) {
    throw Error(ErrorCode::invalid_argument, "the error bound is " + std::to_string(bound.mae) +
                                                 "; use a number above 0 and up to 255");
  }
  if (bound.max_quads < 0 || bound.max_quads > kMaxQuads || bound.max_rounds < 1) {
    throw Error(ErrorCode::invalid_argument,
                "an error bound needs at least one round and at most " + std::to_string(kMaxQuads) +
                    " quads");
  }
}

int ceiling_of(const ErrorBound& bound, const Raster& picture) {
  if (bound.max_quads > 0) return bound.max_quads;
  const double pixels = static_cast<double>(picture.width) * picture.height;
  return static_cast<int>(std::clamp(pixels / kLeastPixelsPerQuad, 1.0, kUsualCeiling));
}

/// The round's result takes the place of the one held when it serves better.
bool serves_better(const BoundedVectorization& held, const ErrorBoundRound& round, int held_quads,
                   bool met) {
  if (met != held.met) return met;
  return met ? round.wished_quads < held_quads : round.mae < held.mae;
}

}  // namespace

BoundedVectorization vectorize_to_error(const Raster& picture, const ErrorBound& bound,
                                        const VectorizeOptions& options,
                                        const RunContext& context) {
  check(bound);
  check_raster(picture);
  const int ceiling = ceiling_of(bound, picture);
  ErrorSearch search(bound.mae, ceiling);
  BoundedVectorization best;
  int best_quads = 0;
  VectorizeOptions wish = options;
  std::optional<int> quads = std::min(options.quads, ceiling);
  while (quads && static_cast<int>(best.rounds.size()) < bound.max_rounds) {
    wish.quads = *quads;
    Vectorization result = vectorize(picture, wish, context);
    StageClock clock(context);
    const double mae = compare(picture, render(result.image, {}, context)).mae;
    const ErrorBoundRound round = {*quads, result.report.quads, mae};
    clock.finish("error bound", {{"wished", *quads}, {"mae", mae}});
    search.observe(*quads, mae);
    const bool met = mae <= bound.mae;
    if (best.rounds.empty() || serves_better(best, round, best_quads, met)) {
      best.result = std::move(result);
      best.mae = mae;
      best.met = met;
      best_quads = *quads;
    }
    best.rounds.push_back(round);
    quads = search.next();
  }
  return best;
}

}  // namespace quadrille
