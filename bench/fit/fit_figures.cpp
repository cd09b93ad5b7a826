#include "fit/fit_figures.h"

#include <algorithm>

#include "fit/jpeg.h"
#include "own_process.h"
#include "process_cost.h"
#include "quadrille/document.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quads/shape.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Colours as the fit's numbers, and two coordinates a vertex: tangents follow from these.
std::size_t stored_scalars(const PatchMesh& patches, const FitMode& fit) {
  const std::size_t channels = patches.opaque ? 3 : 4;
  return patches.wedges.size() * channels * fit.scalars + 2 * patches.mesh.vertices.size();
}

int largest_valence(const QuadMesh& mesh) {
  std::vector<int> edges(mesh.vertex_count());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    ++edges[mesh.origin(mesh.halfedge(e))];
    ++edges[mesh.tip(mesh.halfedge(e))];
  }
  return std::ranges::max(edges);
}

Json measure(const std::filesystem::path& path, const FitRun& run,
             const FitFigureOptions& options) {
  RunContext context;
  context.threads = options.threads;
  const double start = cpu_seconds();
  const Raster picture = load_image(path);
  const Vectorization result = vectorize(picture, run.options(), context);
  const double mae = compare(picture, render(result.image, {}, context)).mae;
  const std::vector<std::byte> document = to_document(result.image, {.error = document_error(mae)});
  Json figures = {{"width", picture.width}, {"height", picture.height}};
  figures["cpu"] = cpu_seconds() - start;
  figures["peak_mb"] = peak_megabytes();

  const PatchMesh& patches = result.image.layers.front().patches;
  figures["quads"] = patches.patch_count();
  figures["scalars"] = stored_scalars(patches, run.fit);
  figures["bytes"] = document.size();
  figures["bytes_per_quad"] = static_cast<double>(document.size()) / patches.patch_count();
  figures["iterations"] = solve_iterations(result.report);
  const ImageDifference difference = compare(picture, render(from_document(document), {}, context));
  figures.update({{"mae", difference.mae}, {"psnr", difference.psnr}, {"ssim", difference.ssim}});
  const ShapeStatistics shape = shape_statistics(patches.mesh);
  figures["jacobian_min"] = shape.jacobian_min;
  figures["jacobian_p5"] = shape.jacobian_p5;
  figures["valence"] = largest_valence(patches.mesh);
  figures["folded"] = result.report.folded;
  if (result.report.fallback) figures["fallback"] = "fallback";
  if (options.jpeg) figures["jpeg"] = jpeg_within(picture, document.size());
  return figures;
}

}  // namespace

Json fit_figures(const std::filesystem::path& picture, const FitRun& run,
                 const FitFigureOptions& options) {
  return run_in_own_process([&] { return measure(picture, run, options); });
}

Json solve_iterations(const VectorizeReport& report) {
  Json counts = Json::object();
  for (const StageReport& stage : report.stages) {
    for (const auto& [name, value] : stage.figures) {
      if (!name.ends_with("iterations") && !name.ends_with("rounds")) continue;
      const std::string label = stage.name + " " + name;
      counts[label] = counts.value(label, 0.0) + value;
    }
  }
  return counts;
}

}  // namespace quadrille::bench
