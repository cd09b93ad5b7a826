#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "quadrille/run_context.h"

namespace quadrille {

/// Runs body(y) for the rows [0, rows) of a grid on the context's threads. The calls must be
/// independent of each other, so that their order cannot matter. Small grids are not worth waking
/// threads for.
template <class Body>
void parallel_rows(const RunContext& context, int rows, int width, const Body& body) {
  constexpr int kLeastPixels = 1 << 15;
  const int grain = kLeastPixels / 4 / (width > 0 ? width : 1) + 1;
  if (context.threads == 1 || static_cast<long long>(rows) * width < kLeastPixels) {
    for (int y = 0; y < rows; ++y) body(y);
    return;
  }
  // oneTBB complains on stderr when asked for more threads than the machine has.
  const int most = tbb::info::default_concurrency();
  tbb::task_arena arena(context.threads > 0 ? std::min(context.threads, most) : most);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, rows, grain),
                      [&](const tbb::blocked_range<int>& range) {
                        for (int y = range.begin(); y < range.end(); ++y) body(y);
                      });
  });
}

}  // namespace quadrille
