#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "quadrille/vectorize.h"

namespace quadrille::viewer {

/// What to compute of a source.
struct RunRequest {
  std::shared_ptr<const Raster> source;
  VectorizeOptions options;
  bool image = true;    ///< vectorize()
  bool stages = false;  ///< quadrangulate()
};

struct RunResult {
  std::shared_ptr<const VectorImage> image;       ///< null when not asked for
  std::shared_ptr<const Quadrangulation> stages;  ///< likewise
  std::string error;  ///< why there is neither; empty when all went well
};

struct RunProgress {
  bool running = false;
  std::string stage;
  double fraction = 0;  ///< of the stage
};

/// A thread that computes one request at a time: the newest. All functions return at once, but for
/// wait() and the destructor, which cancels and waits for the next step of the run.
class BackgroundRun {
 public:
  explicit BackgroundRun(int threads = 0);
  ~BackgroundRun();
  BackgroundRun(const BackgroundRun&) = delete;
  BackgroundRun& operator=(const BackgroundRun&) = delete;

  /// Cancels the run before, whose result will not be seen.
  void start(RunRequest request);
  void cancel();
  RunProgress progress() const;
  /// The result of the newest request, once.
  std::optional<RunResult> take();
  /// Until nothing runs.
  void wait();

 private:
  void work();
  RunResult compute(const RunRequest& request, int number);
  bool note_progress(int number, const std::string& stage, double fraction);

  const int threads_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<RunRequest> wanted_;
  std::optional<RunResult> result_;
  RunProgress progress_;
  int newest_ = 0;  ///< number of the newest request; a run with another number is cancelled
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace quadrille::viewer
