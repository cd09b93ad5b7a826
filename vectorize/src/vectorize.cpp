// Field-aligned Quadrangulation for Image Vectorization (Wei et al. 2019).
#include "quadrille/vectorize.h"

#include <utility>

#include "draft_mesh.h"
#include "patch_fitting.h"
#include "quadrille/mesh_region.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/render.h"
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
  const QuadMesh& mesh = patches.mesh;
  for (const std::vector<int>& chain : feature_edge_chains(mesh)) {
    report.tears += mesh.is_tear(chain.front());
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_tear(e)) continue;
    const int h = mesh.halfedge(e);
    report.tear_length += (mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)]).norm();
  }
  for (int q = 0; q < patches.patch_count(); ++q) {
    report.folded += !certify_fold_free(patch_geometry(patches, q));
  }
  return report;
}

bool is_lattice(const Quadrangulation& quads) {
  return quads.fallback || quads.scale.along_x.data.empty();
}

/// What a rough fit to the mesh shows at scale 1.
Raster drawn(const QuadMesh& mesh, const Raster& shown, const FitOptions& fit,
             const RunContext& context) {
  PatchMesh patches = fit_patches(mesh, shown, draft_options(fit), context);
  return render(single_layer(std::move(patches), shown.width, shown.height), {}, context);
}

/// Tears the chains of feature edges that are worth it; returns the number of candidates.
int tear_chains(QuadMesh& mesh, const Raster& shown, const VectorizeOptions& options,
                const RunContext& context) {
  const std::vector<std::vector<int>> chains = feature_edge_chains(mesh);
  if (chains.empty()) return 0;
  const std::vector<char> is_torn =
      judge_tears(mesh, chains, shown, options.fit, options.tears, context);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    for (const int e : chains[c]) {
      if (is_torn[c]) mesh.edge_flags[e] |= kTearEdge;
    }
  }
  return static_cast<int>(chains.size());
}

}  // namespace

Vectorization vectorize(const Raster& picture, const VectorizeOptions& options,
                        const RunContext& context, Quadrangulation* stages) {
  std::vector<StageReport> reports;
  RunContext recorded = context;
  recorded.on_stage = [&](const StageReport& stage) {
    reports.push_back(stage);
    if (context.on_stage) context.on_stage(stage);
  };

  const MeshQuality quality = options.feedback > 0 ? MeshQuality::draft : MeshQuality::final;
  Quadrangulation quads = quadrangulate(picture, options, quality, recorded);
  const Raster& shown = quads.outline.empty() ? picture : quads.inside;
  for (int round = 0; round < options.feedback && !is_lattice(quads); ++round) {
    refine_by_error(quads, picture, drawn(quads.mesh, shown, options.fit, recorded), options,
                    recorded);
  }
  StageClock clock(recorded);
  const int chains = tear_chains(quads.mesh, shown, options, recorded);
  clock.finish("tears");
  FittedPatches fitted = fitted_patches(stages ? quads.mesh : std::move(quads.mesh), shown,
                                        options.fit, options.optimize, recorded);

  Vectorization result;
  result.report = describe(picture, quads, fitted.patches);
  result.report.chains = chains;
  result.report.fit = fitted.fit;
  result.report.optimize = std::move(fitted.optimized);
  result.report.stages = std::move(reports);
  result.image = single_layer(std::move(fitted.patches), picture.width, picture.height);
  if (stages) *stages = std::move(quads);
  return result;
}

}  // namespace quadrille
