#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "quadrille/run_context.h"

namespace quadrille {

/// Threads of an arena for this run. Never more than the machine has: TBB would not use them, but
/// write a warning to standard error.
inline int arena_size(const RunContext& context) {
  const int most = tbb::info::default_concurrency();
  return context.threads > 0 ? std::min(context.threads, most) : most;
}

/// Work is cut at multiples of this number of elements, whatever the number of threads.
inline constexpr int kRangeSize = 512;

/// Calls body(begin, end) for consecutive ranges that cover [0, count).
template <class Body>
void for_each_range(int count, const Body& body) {
  const int ranges = (count + kRangeSize - 1) / kRangeSize;
  tbb::parallel_for(0, ranges,
                    [&](int r) { body(r * kRangeSize, std::min(count, (r + 1) * kRangeSize)); });
}

/// Adds up body(begin, end) over the same ranges, always in the same order.
template <class T, class Body>
T sum_over_ranges(int count, const T& zero, const Body& body) {
  std::vector<T> partial((count + kRangeSize - 1) / kRangeSize, zero);
  for_each_range(count,
                 [&](int begin, int end) { partial[begin / kRangeSize] = body(begin, end); });
  T sum = zero;
  for (const T& p : partial) sum += p;
  return sum;
}

}  // namespace quadrille
