#include "observer.h"

#include <fmt/core.h>
#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "interrupt.h"

namespace quadrille::cli {
namespace {

constexpr int kBarCells = 24;
constexpr std::chrono::milliseconds kBarInterval{60};

std::string figure(double value) {
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

}  // namespace

Observer::Observer(Verbosity verbosity, int threads, const char* program)
    : workers_(tbb::global_control::max_allowed_parallelism,
               threads > 0 ? threads : tbb::info::default_concurrency()),
      program_(program),
      verbosity_(verbosity),
      terminal_(verbosity != Verbosity::quiet && isatty(STDERR_FILENO) == 1) {
  context_.threads = threads;
  context_.on_progress = [this](const std::string& stage, double fraction) {
    return show_progress(stage, fraction);
  };
  context_.on_stage = [this](const StageReport& stage) { finish(stage); };
}

Observer::~Observer() { erase_bar(); }

bool Observer::show_progress(const std::string& stage, double fraction) {
  const Clock::time_point now = Clock::now();
  if (terminal_ && (stage != bar_stage_ || now - bar_time_ > kBarInterval)) {
    const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kBarCells);
    fmt::print(stderr, "\r\033[K[{}{}] {:3.0f} %  {}", std::string(filled, '#'),
               std::string(kBarCells - filled, '.'), 100 * std::clamp(fraction, 0.0, 1.0), stage);
    std::fflush(stderr);
    bar_shown_ = true;
    bar_stage_ = stage;
    bar_time_ = now;
  }
  return interrupting_signal() == 0;
}

void Observer::finish(const StageReport& stage) {
  stages_.push_back(stage);
  if (verbosity_ != Verbosity::verbose) return;
  std::string line = fmt::format("{:<20}{:>9.3f} s", stage.name, stage.seconds);
  const char* separator = "   ";
  for (const auto& [name, value] : stage.figures) {
    line += fmt::format("{}{} {}", separator, name, figure(value));
    separator = ", ";
  }
  tell(line);
}

void Observer::tell(const std::string& line) {
  if (!terminal_ && verbosity_ != Verbosity::verbose) return;
  erase_bar();
  fmt::print(stderr, "{}\n", line);
}

void Observer::warn(const std::string& line) {
  if (verbosity_ == Verbosity::quiet) return;
  erase_bar();
  fmt::print(stderr, "{}: {}\n", program_, line);
}

void Observer::erase_bar() {
  if (!bar_shown_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  bar_shown_ = false;
}

}  // namespace quadrille::cli
