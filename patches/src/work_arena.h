#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "quadrille/run_context.h"

namespace quadrille {

/// Threads for loops; kept from loop to loop.
class WorkArena {
 public:
  void set_threads(const RunContext& context) {
    // More threads than the machine has would only make oneTBB print a warning.
    const int most = tbb::info::default_concurrency();
    const int wanted = context.threads > 0 ? std::min(context.threads, most) : most;
    if (wanted == threads_) return;
    threads_ = wanted;
    arena_.reset();
    if (threads_ > 1) arena_.emplace(threads_);
  }

  /// Calls body(0) ... body(count - 1).
  template <class Body>
  void for_each(std::size_t count, const Body& body) {
    if (!arena_ || count < 2) {
      for (std::size_t i = 0; i < count; ++i) body(i);
    } else {
      arena_->execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
    }
  }

 private:
  int threads_ = 1;
  std::optional<tbb::task_arena> arena_;
};

}  // namespace quadrille
