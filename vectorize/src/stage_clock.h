#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/run_context.h"

namespace quadrille {

/// Tells the context's observer how long each stage took since the one before.
class StageClock {
 public:
  explicit StageClock(const RunContext& context)
      : context_(context), start_(std::chrono::steady_clock::now()) {}

  void finish(const std::string& stage, std::vector<std::pair<std::string, double>> figures = {}) {
    const auto now = std::chrono::steady_clock::now();
    if (context_.on_stage) {
      context_.on_stage(
          {stage, std::chrono::duration<double>(now - start_).count(), std::move(figures)});
    }
    start_ = now;
  }

 private:
  const RunContext& context_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace quadrille
