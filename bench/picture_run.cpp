#include "picture_run.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include "gzip_size.h"
#include "own_process.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"
#include "scratch_folder.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) { return t.tv_sec + t.tv_usec * 1e-6; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json quality(const VectorImage& image, const Raster& picture, const RunContext& context) {
  const ImageDifference difference = compare(picture, render(image, {}, context));
  return {{"quads", image.patch_count()},
          {"mae", difference.mae},
          {"psnr", difference.psnr},
          {"ssim", difference.ssim}};
}

Json file_sizes(const VectorImage& image, const RunContext& context) {
  const ScratchFolder folder;
  Json sizes;
  for (const std::string& ending : export_endings()) {
    if (ending != ".quad" && ending != ".svg" && ending != ".pdf" && ending != ".glb" &&
        ending != ".vtu") {
      continue;
    }
    const fs::path file = folder.path / ("picture" + ending);
    export_image(image, file, {}, context);
    sizes[ending] = fs::file_size(file);
    if (ending == ".svg") sizes[".svg.gz"] = gzip_size(file);
  }
  return sizes;
}

/// What an honest result must not have, as words; empty when all is well.
std::string problems(const Vectorization& result, const RunContext& context) {
  const PatchMesh& patches = result.image.layers.front().patches;
  const CoverageReport coverage = count_coverage(result.image, {}, context);
  const auto violations = validate(patches.mesh, result.image.width, result.image.height);
  std::string words;
  const auto note = [&](long long count, const char* what) {
    if (count > 0) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, what);
  };
  note(static_cast<long long>(violations.size()), "violations");
  note(result.report.folded, "folded");
  note(coverage.uncovered, "uncovered");
  note(coverage.doubly_covered, "doubly covered");
  if (result.report.fallback) words += words.empty() ? "fallback" : ", fallback";
  return words;
}

Json measure_picture(const fs::path& path, const PictureRunOptions& run) {
  RunContext context;
  context.threads = run.threads;
  VectorizeOptions options;
  options.quads = run.quads;

  const auto start = std::chrono::steady_clock::now();
  const Raster picture = load_image(path);
  Vectorization result = vectorize(picture, options, context);
  Json json = {{"width", picture.width}, {"height", picture.height}};
  json["hermite"] = quality(result.image, picture, context);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  json["seconds"] = seconds.count();
  json["cpu_seconds"] = cpu_seconds(usage);
  json["peak_mb"] = usage.ru_maxrss * 1024 / 1e6;
  json["stages"] = Json::object();
  for (const StageReport& stage : result.report.stages) {
    json["stages"][stage.name] = json["stages"].value(stage.name, 0.0) + stage.seconds;
  }
  json["problems"] = problems(result, context);
  if (run.files) json["files"] = file_sizes(result.image, context);

  FitOptions bessel;
  bessel.method = FitMethod::bessel;
  fit_colors(result.image.layers.front().patches, picture, bessel, context);
  json["bessel"] = quality(result.image, picture, context);
  options.lattice = true;
  json["lattice"] = quality(vectorize(picture, options, context).image, picture, context);
  return json;
}

}  // namespace

Json run_picture(const fs::path& picture, const PictureRunOptions& options) {
  return run_in_own_process([&] { return measure_picture(picture, options); });
}

}  // namespace quadrille::bench
