#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "count_calibration.h"
#include "density_map.h"
#include "meshed_region.h"
#include "opaque_picture.h"
#include "option_checks.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "quadrille/vectorize.h"
#include "region_features.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

constexpr int kCalibrationRounds = 24;  // one or two for most pictures
// An outline may need more quads than wished, whatever the lattice.
constexpr int kOutlineRounds = 6;
constexpr double kCloseEnough = 0.049;  // of the wished count
// Cells asked for over cells made where the scale is graded: points too close to each other merge.
constexpr double kGradingLoss = 1.1;
// Lets a picture of exactly 4 quads a side count as one.
constexpr double kRoundingSlack = 1 + 1e-9;
// Lattice edges inside an outline for which fields are solved, in source pixels.
constexpr double kShortestRegionEdge = 2;

void check(const VectorizeOptions& options) {
  if (options.quads < 1) {
    throw Error(ErrorCode::invalid_argument,
                "the number of quads is " + std::to_string(options.quads) + "; ask for at least 1");
  }
  if (options.quads > kMaxQuads) {
    throw Error(ErrorCode::limit_exceeded, "the number of quads is " +
                                               std::to_string(options.quads) +
                                               "; ask for at most " + std::to_string(kMaxQuads));
  }
  check_options(options.cross_field);
  check_options(options.scale);
  check_options(options.position);
  check_options(options.snap);
}

double relative_miss(int quads, int wished) {
  return std::abs(static_cast<double>(quads) - wished) / wished;
}

bool has_features(const FeatureTensor& features) {
  return std::any_of(features.edges.data.begin(), features.edges.data.end(),
                     [](unsigned char e) { return e != 0; });
}

/// Whole rows and columns of square cells may keep stepping over the wished count, so later rounds
/// stretch the cells or give up whole ones.
SideFit side_fit(int round) {
  constexpr double kCounted = 0.02;
  constexpr std::array<double, 5> kStretches = {1, 1.1, 1 / 1.1, 1.2, 1 / 1.2};
  if (round < 3) return {};
  return {round % 2 != 0, kCounted, kStretches[(round - 3) / 2 % kStretches.size()]};
}

bool is_valid(const QuadMesh& mesh, const std::vector<Loop>& outline, const Raster& picture) {
  if (mesh.quad_count() == 0) return false;
  const auto violations = outline.empty() ? validate(mesh, picture.width, picture.height)
                                          : validate_region(mesh, picture.width, picture.height);
  return violations.empty();
}

QuadMesh extract(const Quadrangulation& fields, const ScaleField& scale,
                 const PositionField& position, const Raster& picture, const RunContext& context) {
  if (fields.outline.empty()) {
    return extract_quads(fields.features, fields.cross, scale, position, picture.width,
                         picture.height, context);
  }
  return extract_quads(fields.features, fields.cross, scale, position, fields.outline,
                       picture.width, picture.height, context);
}

/// Scales, positions and quads for the solved cross field, repeated with corrected scales until the
/// count is close to the wished one; keeps the closest.
void mesh_to_count(Quadrangulation& result, const Raster& picture, double edge,
                   const VectorizeOptions& options, StageClock& clock, const RunContext& context) {
  ScaleOptions scale_options = options.scale;
  if (!options.density.data.empty()) {
    scale_options.density =
        density_map(options.density, result.cross.z.width, result.cross.z.height);
  }
  const ScaleField relative = relative_scale(result.features, result.cross,
                                             edge / result.working.scale_x, scale_options, context);
  const bool whole = result.outline.empty();
  const double share = whole ? 1 : share_of_cells(result.outline, result.working, relative);
  // Along an outline vertices are added about as often as points merge where the scale is graded.
  const double loss = whole && has_features(result.features) ? kGradingLoss : 1;
  CountCalibration calibration(options.quads, options.quads / 4.0 * loss / share);
  const int rounds = whole ? kCalibrationRounds : kOutlineRounds;
  for (int round = 0; round < rounds; ++round) {
    ScaleField scale =
        scaled_to_count(relative, result.cross, calibration.cells(), side_fit(round));
    clock.finish("scale field");
    PositionField position =
        position_field(result.features, result.cross, scale, options.position, context);
    clock.finish("position field");
    QuadMesh mesh = extract(result, scale, position, picture, context);
    const int quads = mesh.quad_count();
    const bool valid = is_valid(mesh, result.outline, picture);
    clock.finish("quads", {{"asked", std::round(4 * share * calibration.cells())},
                           {"quads", static_cast<double>(quads)}});
    if (round == 0 || (valid && relative_miss(quads, options.quads) <
                                    relative_miss(result.mesh.quad_count(), options.quads))) {
      result.mesh = std::move(mesh);
      result.scale = std::move(scale);
      result.position = std::move(position);
    }
    if (valid && relative_miss(quads, options.quads) <= kCloseEnough) return;
    calibration.observe(quads);
  }
}

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
                    const VectorizeOptions& options, const RunContext& context) {
  StageClock clock(context);
  const bool whole = result.outline.empty();
  const Raster& shown = whole ? picture : result.inside;
  result.working = make_working_picture(shown, edge);
  result.features = feature_tensor(result.working.picture, {}, context);
  if (!whole) confine_features(result.features, result.outline, result.working);
  clock.finish("features");
  result.cross = cross_field(result.features, options.cross_field, context);
  clock.finish("cross field", phase_figures(result.cross));
  mesh_to_count(result, picture, edge, options, clock, context);
  snap_to_features(result.mesh, shown, options.snap, context);
  clock.finish("snapping");
}

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  check(options);
  check_raster(picture);
  if (!options.density.data.empty()) check_raster(options.density);
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
  if (has_room && !options.lattice) mesh_by_fields(result, picture, edge, options, context);
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
