#include "fit/size_growth.h"

#include <fmt/core.h>

#include "fit/fit_figures.h"
#include "own_process.h"
#include "process_cost.h"
#include "quadrille/image_file.h"
#include "resample.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

Json measure(const std::filesystem::path& path, int factor, int quads, int threads) {
  const Raster picture = enlarged(load_image(path), factor, Interpolation::bicubic);
  RunContext context;
  context.threads = threads;
  VectorizeOptions options;
  options.quads = quads;
  const double start = cpu_seconds();
  const VectorizeReport report = vectorize(picture, options, context).report;
  return {{"size", fmt::format("{}x{}", picture.width, picture.height)},
          {"quads", report.quads},
          {"cpu", cpu_seconds() - start},
          {"peak_mb", peak_megabytes()},
          {"iterations", solve_iterations(report)}};
}

}  // namespace

std::vector<TableRow> iterations_with_size(const std::filesystem::path& picture, int quads,
                                           int threads) {
  std::vector<TableRow> rows;
  const auto add = [&](int factor, int count, const char* what) {
    rows.push_back({fmt::format("{}x, {}", factor, what),
                    run_in_own_process([&] { return measure(picture, factor, count, threads); })});
  };
  for (const int factor : {1, 2, 4}) add(factor, quads, "same quads");
  for (const int factor : {2, 4}) add(factor, factor * factor * quads, "same pixels per quad");
  return rows;
}

}  // namespace quadrille::bench
