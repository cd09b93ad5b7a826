#include "option_checks.h"

#include <string>

#include "quadrille/error.h"
#include "quadrille/vectorize.h"

namespace quadrille {

void check_options(const VectorizeOptions& options) {
  if (options.quads < 1) {
    throw Error(ErrorCode::invalid_argument,
                "the number of quads is " + std::to_string(options.quads) + "; ask for at least 1");
  }
  if (options.quads > kMaxQuads) {
    throw Error(ErrorCode::limit_exceeded, "the number of quads is " +
                                               std::to_string(options.quads) +
                                               "; ask for at most " + std::to_string(kMaxQuads));
  }
  check_options(options.cross_field);
  check_options(options.scale);
  check_options(options.position);
  check_options(options.snap);
  check_options(options.chains);
  check_options(options.tears);
  check_options(options.fit);
  check_options(options.optimize);
  if (options.feedback < 0) {
    throw Error(
        ErrorCode::invalid_argument,
        "the number of feedback rounds is " + std::to_string(options.feedback) + "; use 0 or more");
  }
  if (!(options.chain_share >= 0 && options.chain_share <= 1) || !(options.least_chain_gain >= 0)) {
    throw Error(ErrorCode::invalid_argument,
                "the share of vertices on chains is from 0 to 1, and the least gain at least 0");
  }
  if (!options.density.data.empty()) check_raster(options.density);
}

}  // namespace quadrille
