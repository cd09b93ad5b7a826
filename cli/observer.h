#pragma once

#include <oneapi/tbb/global_control.h>

#include <chrono>
#include <string>
#include <type_traits>
#include <vector>

#include "quadrille/run_context.h"

namespace quadrille::cli {

enum class Verbosity { quiet, normal, verbose };

/// Watches a run: draws the progress bar when stderr is a terminal, prints a line per stage when
/// verbose, keeps the stages for the report, and cancels after an interrupt.
class Observer {
 public:
  /// Warnings begin with the name of the program.
  Observer(Verbosity verbosity, int threads, const char* program = "quadrille");
  ~Observer();
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  /// For the library's functions; lives as long as the observer.
  const RunContext& context() const { return context_; }
  const std::vector<StageReport>& stages() const { return stages_; }

  /// Runs `work` as a stage of the command's own, beside those that the library reports.
  template <class Work>
  auto stage(const std::string& name, Work&& work) {
    context_.progress(name, 0);
    const Clock::time_point start = Clock::now();
    if constexpr (std::is_void_v<decltype(work())>) {
      work();
      finish({name, seconds_since(start), {}});
    } else {
      auto result = work();
      finish({name, seconds_since(start), {}});
      return result;
    }
  }

  /// A line on stderr for whoever watches: on a terminal, or when verbose.
  void tell(const std::string& line);
  /// A line on stderr that only --quiet leaves out.
  void warn(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  bool show_progress(const std::string& stage, double fraction);
  void finish(const StageReport& stage);
  void erase_bar();

  // Lets the library have as many workers as asked for, even more than the machine has.
  tbb::global_control workers_;
  const char* program_;
  Verbosity verbosity_;
  bool terminal_;
  bool bar_shown_ = false;
  std::string bar_stage_;
  Clock::time_point bar_time_;
  std::vector<StageReport> stages_;
  RunContext context_;
};

}  // namespace quadrille::cli
