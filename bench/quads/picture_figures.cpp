#include "picture_figures.h"

#include "field_phases.h"
#include "front_half.h"
#include "quadrille/fit.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "shape.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kTimedRuns = 3;

Json shape_figures(const QuadMesh& mesh, const Raster& picture) {
  const ShapeStatistics shape = shape_statistics(mesh);
  return {{"jacobian_min", shape.jacobian_min},       {"jacobian_p5", shape.jacobian_p5},
          {"jacobian_mean", shape.jacobian_mean},     {"irregular", shape.irregular_share},
          {"anisotropy_mean", shape.anisotropy_mean}, {"anisotropy_max", shape.anisotropy_max},
          {"aligned", aligned_share(mesh, picture)}};
}

/// How well patches on the mesh reproduce the picture.
Json fit_figures(QuadMesh mesh, const Raster& picture, const RunContext& context) {
  const VectorImage image = single_layer(fit_patches(std::move(mesh), picture, {}, context),
                                         picture.width, picture.height);
  const ImageDifference difference = compare(picture, render(image, {}, context));
  return {{"quads", image.patch_count()}, {"mae", difference.mae}, {"psnr", difference.psnr}};
}

}  // namespace

Json picture_figures(const std::filesystem::path& path, const PictureOptions& options) {
  const Raster picture = load_image(path);
  RunContext context;
  context.threads = options.threads;
  FrontHalf front = measure_front_half(picture, {options.quads, options.threads, kTimedRuns});
  Json figures;
  figures["fields"] = field_figures(front.quads);
  figures["shape"] = shape_figures(front.quads.mesh, picture);
  figures["front"] = std::move(front.figures);
  figures["ours"] = fit_figures(std::move(front.quads.mesh), picture, context);
  figures["lattice"] =
      fit_figures(lattice_mesh(picture.width, picture.height, options.quads), picture, context);
  return figures;
}

}  // namespace quadrille::bench
