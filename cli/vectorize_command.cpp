#include <fmt/core.h>

#include <chrono>
#include <memory>
#include <optional>

#include "command.h"
#include "common_options.h"
#include "output_files.h"
#include "picture_input.h"
#include "quadrille/render.h"
#include "report.h"

namespace quadrille::cli {
namespace {

namespace fs = std::filesystem;

struct VectorizeRequest {
  fs::path input;
  std::vector<fs::path> outputs;
  fs::path report;
  double scale = 1;
  DocumentOptions document;
  MeshOptions mesh;
  RunOptions run;
};

void check_scale(const Raster& picture, double scale) {
  VectorImage empty;
  empty.width = picture.width;
  empty.height = picture.height;
  RenderOptions options;
  options.scale = scale;
  output_size(empty, options);  // throws when there is no such picture
}

int run_vectorize(const VectorizeRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  check_outputs(request.outputs, request.input, export_endings());
  if (!request.report.empty()) check_outputs({request.report}, request.input, {".json"});
  Observer observer(request.run.verbosity(), request.run.threads);

  const Raster picture = read_raster(request.input, observer);
  check_scale(picture, request.scale);
  const Vectorization result = vectorize_picture(picture, request.input, request.mesh, observer);
  ExportOptions options;
  options.raster.scale = request.scale;
  options.document = request.document;
  write_outputs(result.image, request.outputs, options, observer);

  if (request.report.empty() && request.run.verbosity() != Verbosity::verbose) return kSuccess;
  const Measurement measurement = measure(result.image, picture, observer);
  observer.tell(fmt::format("{} quads, MAE {:.2f}, PSNR {:.2f} dB, SSIM {:.3f}",
                            result.report.quads, measurement.difference.mae,
                            measurement.difference.psnr, measurement.difference.ssim));
  if (!request.report.empty()) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    write_report(
        {request.input, request.mesh, result.report, measurement, request.outputs, seconds.count()},
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
  parser.add_option("--scale", request->scale, "output pixels per source pixel, for pixel formats")
      ->check(positive_number())
      ->capture_default_str();
  declare_document_options(parser, request->document);
  parser.add_option("--report", request->report, "write what the run measured as JSON")
      ->type_name("FILE.json");
  declare_run_options(parser, request->run);
  return [request] { return run_vectorize(*request); };
}

}  // namespace quadrille::cli
