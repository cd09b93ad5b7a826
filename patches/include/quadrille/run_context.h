#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace quadrille {

/// What a finished stage tells its observer: wall seconds and named figures in a fixed order.
struct StageReport {
  std::string name;
  double seconds = 0;
  std::vector<std::pair<std::string, double>> figures;
};

/// How a long computation runs and whom it tells. Passed down by reference; libraries never print.
struct RunContext {
  /// Worker threads; 0 means all that the machine has. Results never depend on it.
  int threads = 0;
  /// Called with the stage's name and its completed fraction in [0, 1]; returning false cancels the
  /// run, which then throws Error{cancelled}. Called from one thread at a time.
  std::function<bool(const std::string& stage, double fraction)> on_progress;
  /// Called once per finished stage.
  std::function<void(const StageReport&)> on_stage;

  /// Reports progress; throws Error{cancelled} when the observer asks to stop.
  void progress(const std::string& stage, double fraction) const;
};

}  // namespace quadrille
