#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "command.h"
#include "common_options.h"
#include "export_options.h"
#include "output_files.h"
#include "picture_input.h"
#include "report.h"

namespace quadrille::cli {
namespace {

namespace fs = std::filesystem;

struct VectorizeRequest {
  fs::path input;
  std::vector<fs::path> outputs;
  fs::path report;
  ExportOptions files;
  std::optional<double> max_error;
  MeshOptions mesh;
  RunOptions run;
};

/// With a bound on the error, --quads is the ceiling and the preset's number only the start.
BoundedVectorization vectorize_within(const VectorizeRequest& request, const Raster& picture,
                                      const VectorizeOptions& options, Observer& observer) {
  ErrorBound bound;
  bound.mae = *request.max_error;
  bound.max_quads = request.mesh.quads.value_or(0);
  BoundedVectorization bounded =
      vectorize_picture_to_error(picture, request.input, bound, options, observer);
  observer.tell(fmt::format("error bound {}: {:.2f} after {} rounds", bound.mae, bounded.mae,
                            bounded.rounds.size()));
  if (!bounded.met) {
    observer.warn(
        fmt::format("warning: '{}' keeps an error of {:.2f} with {} quads, above the {} asked for; "
                    "allow more with --quads or a larger --max-error",
                    request.input.string(), bounded.mae, bounded.result.report.quads, bound.mae));
  }
  return bounded;
}

struct Made {
  BoundedVectorization bounded;
  std::optional<Quadrangulation> stages;
};

/// Keeps the stages when an output shows them; the rounds of an error bound do not.
Made make(const VectorizeRequest& request, const Raster& picture, const VectorizeOptions& options,
          Observer& observer) {
  if (request.max_error) return {vectorize_within(request, picture, options, observer), {}};
  const bool shows_stages = std::ranges::any_of(
      request.outputs, [](const fs::path& output) { return ending_of(output) == ".vtm"; });
  if (!shows_stages) return {{vectorize_picture(picture, request.input, options, observer)}, {}};
  StagedVectorization staged = vectorize_in_stages(picture, request.input, options, observer);
  return {{std::move(staged.result)}, std::move(staged.stages)};
}

int run_vectorize(const VectorizeRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<fs::path> inputs = {request.input, request.mesh.density};
  check_outputs(request.outputs, inputs, export_endings());
  if (!request.report.empty()) check_outputs({request.report}, inputs, {".json"});
  Observer observer(request.run.verbosity(), request.run.threads);

  const Raster picture = read_picture(request.input, observer);
  for (const fs::path& output : request.outputs) {
    check_size(picture.width, picture.height, request.files.raster, output);
  }
  MeshOptions mesh = request.mesh;
  if (request.max_error) mesh.quads.reset();
  const ChosenOptions chosen = choose_options(mesh, picture, observer);
  const auto [bounded, stages] = make(request, picture, chosen.vectorize, observer);
  const Vectorization& result = bounded.result;
  const Origin origin{&picture, stages ? &*stages : nullptr};
  write_outputs({result.image, origin}, request.outputs, request.files, observer);

  if (request.report.empty() && request.run.verbosity() != Verbosity::verbose) return kSuccess;
  const Measurement measurement = measure(result.image, picture, observer);
  const ImageDifference& difference = measurement.difference;
  const std::string ssim =
      std::isnan(difference.ssim) ? "" : fmt::format(", SSIM {:.3f}", difference.ssim);
  observer.tell(fmt::format("{} quads, MAE {:.2f}, PSNR {:.2f} dB{}", result.report.quads,
                            difference.mae, difference.psnr, ssim));
  if (!request.report.empty()) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    write_report({request.input, request.mesh, chosen, result.report, bounded.rounds,
                  request.max_error, measurement, request.outputs, seconds.count()},
                 observer, request.report);
  }
  return kSuccess;
}

}  // namespace

Action declare_vectorize(CLI::App& parser) {
  const auto request = std::make_shared<VectorizeRequest>();
  declare_input(parser, request->input, "picture to vectorize (PNG, JPEG, WebP, TIFF, ...)");
  declare_outputs(parser, request->outputs);
  declare_mesh_options(parser, request->mesh);
  parser
      .add_option("--max-error", request->max_error,
                  "search the number of quads that this mean absolute error (0 to 255, as of "
                  "compare) takes; --quads is then the most, by default one per 4 pixels up to "
                  "200000")
      ->check(positive_number())
      ->check(number_from(0, 255));
  declare_export_options(parser, request->files);
  parser.add_option("--report", request->report, "write what the run measured as JSON")
      ->check(file_name())
      ->type_name("FILE.json");
  declare_run_options(parser, request->run);
  return [request] { return run_vectorize(*request); };
}

}  // namespace quadrille::cli
