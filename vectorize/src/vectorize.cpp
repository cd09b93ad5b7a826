// Field-aligned Quadrangulation for Image Vectorization (Wei et al. 2019).
#include "quadrille/vectorize.h"

#include "quadrille/mesh_region.h"
#include "quadrille/patch_geometry.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

VectorizeReport describe(const Raster& picture, const Quadrangulation& quads,
                         const PatchMesh& patches) {
  VectorizeReport report;
  report.width = picture.width;
  report.height = picture.height;
  report.quads = patches.mesh.quad_count();
  report.vertices = patches.mesh.vertex_count();
  report.irregular_vertices = count_irregular_vertices(patches.mesh);
  report.fallback = quads.fallback;
  report.region = quads.outline.empty() ? MeshRegion::whole : MeshRegion::opaque;
  const MeshRegionSize size = region_size(patches.mesh);
  report.components = size.components;
  report.holes = size.holes;
  report.outline_length = size.outline_length;
  for (const Singularity& s : singularities(quads.cross)) {
    ++(s.quarter_index > 0 ? report.positive_singularities : report.negative_singularities);
  }
  report.misalignment_degrees = misalignment_degrees(quads.cross, quads.features);
  report.cross_field_phases = quads.cross.phases;
  for (int q = 0; q < patches.patch_count(); ++q) {
    report.folded += !certify_fold_free(patch_geometry(patches, q));
  }
  return report;
}

VectorImage picture_of(const Raster& picture, PatchMesh patches) {
  VectorImage image;
  image.width = picture.width;
  image.height = picture.height;
  image.layers.emplace_back().patches = std::move(patches);
  return image;
}

}  // namespace

Vectorization vectorize(const Raster& picture, const VectorizeOptions& options,
                        const RunContext& context) {
  std::vector<StageReport> stages;
  RunContext recorded = context;
  recorded.on_stage = [&](const StageReport& stage) {
    stages.push_back(stage);
    if (context.on_stage) context.on_stage(stage);
  };

  Quadrangulation quads = quadrangulate(picture, options, recorded);
  StageClock clock(recorded);
  PatchMesh patches = straight_patches(std::move(quads.mesh));
  set_bessel_tangents(patches);
  guard_folds(patches);
  clock.finish("patches");
  const Raster& shown = quads.outline.empty() ? picture : quads.inside;
  const FitReport fit = fit_colors(patches, shown, options.fit, recorded);
  clock.finish("colours", {{"iterations", fit.iterations}});
  const OptimizeReport optimized =
      optimize_vertices(patches, shown, options.optimize, options.fit, recorded);
  clock.finish("vertices", {{"rounds", optimized.rounds.size()}, {"accepted", optimized.accepted}});

  Vectorization result;
  result.report = describe(picture, quads, patches);
  result.report.fit = fit;
  result.report.optimize = optimized;
  result.report.stages = std::move(stages);
  result.image = picture_of(picture, std::move(patches));
  return result;
}

}  // namespace quadrille
