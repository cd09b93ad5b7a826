#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "chosen_options.h"
#include "common_options.h"
#include "observer.h"
#include "quadrille/error_bound.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"

namespace quadrille::cli {

/// What drawing the result at scale 1 shows about it.
struct Measurement {
  ImageDifference difference;
  CoverageReport coverage;
};

Measurement measure(const VectorImage& image, const Raster& picture, Observer& observer);

/// Everything a report tells about one run of `vectorize`.
struct RunReport {
  std::filesystem::path source;
  const MeshOptions& options;
  const ChosenOptions& chosen;
  const VectorizeReport& vectorization;
  const std::vector<ErrorBoundRound>& rounds;  ///< of the search for the error; empty without one
  std::optional<double> max_error;             ///< the wished one
  const Measurement& measurement;
  std::vector<std::filesystem::path> outputs;
  double seconds = 0;  ///< wall time of the whole run
};

/// Writes the report as JSON (docs/command.md lists the fields). Throws Error{io_failure}.
void write_report(const RunReport& report, const Observer& observer,
                  const std::filesystem::path& path);

}  // namespace quadrille::cli
