#include <algorithm>
#include <cmath>
#include <string>

#include "count_calibration.h"
#include "count_meshing.h"
#include "draft_mesh.h"
#include "meshed_region.h"
#include "opaque_picture.h"
#include "option_checks.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "quadrille/vectorize.h"
#include "region_features.h"

namespace quadrille {
namespace {

// Lets a picture of exactly 4 quads a side count as one.
constexpr double kRoundingSlack = 1 + 1e-9;
// Lattice edges inside an outline for which fields are solved, in source pixels.
constexpr double kShortestRegionEdge = 2;
constexpr double kDraftMiss = 0.1;  // of a draft's count, relative

std::vector<std::pair<std::string, double>> phase_figures(const CrossField& cross) {
  std::vector<std::pair<std::string, double>> figures;
  for (const CrossFieldPhase& phase : cross.phases) {
    figures.emplace_back(phase.name + " singularities",
                         static_cast<double>(phase.singularities.size()));
    figures.emplace_back(phase.name + " energy", phase.energy);
    figures.emplace_back(phase.name + " misalignment", phase.misalignment_degrees);
  }
  return figures;
}

/// The lattice trimmed by the outline, with about the wished count.
QuadMesh trimmed_lattice(const std::vector<Loop>& outline, const Raster& picture, double area,
                         int wished) {
  CountCalibration calibration(wished, wished);
  QuadMesh best;
  for (int round = 0; round < kOutlineRounds; ++round) {
    QuadMesh mesh =
        lattice_mesh(outline, picture.width, picture.height, std::sqrt(area / calibration.cells()));
    const int quads = mesh.quad_count();
    if (round == 0 || relative_miss(quads, wished) < relative_miss(best.quad_count(), wished)) {
      best = std::move(mesh);
    }
    if (relative_miss(quads, wished) <= kCloseEnough) break;
    calibration.observe(quads);
  }
  return best;
}

/// The fields' mesh of the whole picture, or of the inside of the outline.
void mesh_by_fields(Quadrangulation& result, const Raster& picture, double edge,
                    const VectorizeOptions& options, MeshQuality quality,
                    const RunContext& context) {
  StageClock clock(context);
  const bool whole = result.outline.empty();
  const Raster& shown = whole ? picture : result.inside;
  result.working = make_working_picture(shown, edge);
  result.features = feature_tensor(result.working.picture, {}, context);
  if (!whole) confine_features(result.features, result.outline, result.working);
  clock.finish("features");
  result.cross = cross_field(result.features, options.cross_field, context);
  clock.finish("cross field", phase_figures(result.cross));
  const bool is_draft = quality == MeshQuality::draft;
  const CountWish wish = {wished_density(result, options), is_draft ? kDraftMiss : kCloseEnough};
  mesh_to_count(result, picture, edge, options, wish, clock, context);
  if (is_draft) return;
  snap_to_features(result.mesh, shown, options.snap, context);
  clock.finish("snapping");
}

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  return quadrangulate(picture, options, MeshQuality::final, context);
}

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              MeshQuality quality, const RunContext& context) {
  check_options(options);
  check_raster(picture);
  Quadrangulation result;
  result.outline = wanted_outline(picture, options);
  const bool whole = result.outline.empty();
  if (!whole) result.inside = opaque_picture(picture);
  const double width = picture.width, height = picture.height;
  const double area = region_area(result.outline, picture);
  // Faces are extracted at twice the wished edge length; dividing each of them halves it.
  const double edge = 2 * std::sqrt(area / options.quads);
  // The fields cover the rectangle, at a resolution that a small outline would drive up.
  const bool worthwhile = whole || edge >= kShortestRegionEdge;
  const bool has_room = worthwhile && 2 * edge <= std::min(width, height) * kRoundingSlack;
  if (has_room && !options.lattice) {
    mesh_by_fields(result, picture, edge, options, quality, context);
  }
  if (is_valid(result.mesh, result.outline, picture)) return result;

  result.fallback = !options.lattice;
  result.mesh = whole ? lattice_mesh(width, height, options.quads)
                      : trimmed_lattice(result.outline, picture, area, options.quads);
  if (!is_valid(result.mesh, result.outline, picture)) {
    throw Error(ErrorCode::numerical_failure,
                "no valid mesh was found for the picture's outline; mesh the whole picture");
  }
  return result;
}

}  // namespace quadrille
