#include "background_run.h"

#include <exception>
#include <utility>

#include "quadrille/error.h"

namespace quadrille::viewer {

BackgroundRun::BackgroundRun(int threads) : threads_(threads), thread_([this] { work(); }) {}

BackgroundRun::~BackgroundRun() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    ++newest_;
    wanted_.reset();
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundRun::start(RunRequest request) {
  {
    const std::lock_guard lock(mutex_);
    ++newest_;
    wanted_ = std::move(request);
    result_.reset();
    progress_ = {true, "starting", 0};
  }
  changed_.notify_all();
}

void BackgroundRun::cancel() {
  const std::lock_guard lock(mutex_);
  ++newest_;
  wanted_.reset();
  result_.reset();
  progress_.running = false;
  changed_.notify_all();
}

RunProgress BackgroundRun::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::optional<RunResult> BackgroundRun::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

void BackgroundRun::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !progress_.running; });
}

void BackgroundRun::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || wanted_; });
    if (ending_) return;
    const RunRequest request = *std::exchange(wanted_, std::nullopt);
    const int number = newest_;
    lock.unlock();
    RunResult result = compute(request, number);
    lock.lock();
    if (number != newest_) continue;
    result_ = std::move(result);
    progress_.running = false;
    changed_.notify_all();
  }
}

RunResult BackgroundRun::compute(const RunRequest& request, int number) {
  RunContext context;
  context.threads = threads_;
  context.on_progress = [&](const std::string& stage, double fraction) {
    return note_progress(number, stage, fraction);
  };
  RunResult result;
  try {
    if (request.image) {
      Vectorization made = vectorize(*request.source, request.options, context);
      result.image = std::make_shared<const VectorImage>(std::move(made.image));
    }
    if (request.stages) {
      result.stages = std::make_shared<const Quadrangulation>(
          quadrangulate(*request.source, request.options, context));
    }
  } catch (const std::bad_alloc&) {
    return {nullptr, nullptr, "out of memory; try fewer quads"};
  } catch (const std::exception& error) {
    return {nullptr, nullptr, error.what()};
  }
  return result;
}

bool BackgroundRun::note_progress(int number, const std::string& stage, double fraction) {
  const std::lock_guard lock(mutex_);
  if (number != newest_) return false;
  progress_ = {true, stage, fraction};
  return true;
}

}  // namespace quadrille::viewer
