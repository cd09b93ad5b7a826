#pragma once

#include <oneapi/tbb/info.h>

#include <algorithm>

#include "quadrille/run_context.h"

namespace quadrille {

/// Threads of an arena for this run. Never more than the machine has: TBB would not use them, but
/// write a warning to standard error.
inline int arena_size(const RunContext& context) {
  const int most = tbb::info::default_concurrency();
  return context.threads > 0 ? std::min(context.threads, most) : most;
}

}  // namespace quadrille
