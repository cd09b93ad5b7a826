#include <algorithm>
#include <cmath>
#include <string>

#include "count_calibration.h"
#include "quadrille/error.h"
#include "quadrille/vectorize.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

constexpr int kCalibrationRounds = 24;  // one or two for most pictures
constexpr double kCloseEnough = 0.05;   // of the wished count
// Cells asked for over cells made where the scale is graded: points too close to each other merge.
constexpr double kGradingLoss = 1.1;
// Lets a picture of exactly 4 quads a side count as one.
constexpr double kRoundingSlack = 1 + 1e-9;

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
}

double relative_miss(int quads, int wished) {
  return std::abs(static_cast<double>(quads) - wished) / wished;
}

bool has_features(const FeatureTensor& features) {
  return std::any_of(features.edges.data.begin(), features.edges.data.end(),
                     [](unsigned char e) { return e != 0; });
}

/// Whole rows and columns may keep stepping over the wished count, so later rounds give them up.
SideDivision side_division(int round) {
  if (round < 3) return SideDivision::square;
  return round % 2 ? SideDivision::counted : SideDivision::none;
}

/// Scales, positions and quads for the solved cross field, repeated with corrected scales until the
/// count is close to the wished one; keeps the closest.
void mesh_to_count(Quadrangulation& result, double width, double height, double edge,
                   const VectorizeOptions& options, StageClock& clock, const RunContext& context) {
  const ScaleField relative = relative_scale(result.features, result.cross,
                                             edge / result.working.scale_x, options.scale, context);
  CountCalibration calibration(
      options.quads, options.quads / 4.0 * (has_features(result.features) ? kGradingLoss : 1));
  for (int round = 0; round < kCalibrationRounds; ++round) {
    ScaleField scale =
        scaled_to_count(relative, result.cross, calibration.cells(), side_division(round));
    clock.finish("scale field");
    PositionField position =
        position_field(result.features, result.cross, scale, options.position, context);
    clock.finish("position field");
    QuadMesh mesh =
        extract_quads(result.features, result.cross, scale, position, width, height, context);
    const int quads = mesh.quad_count();
    clock.finish("quads", {{"asked", std::round(4 * calibration.cells())},
                           {"quads", static_cast<double>(quads)}});
    if (round == 0 || relative_miss(quads, options.quads) <
                          relative_miss(result.mesh.quad_count(), options.quads)) {
      result.mesh = std::move(mesh);
      result.scale = std::move(scale);
      result.position = std::move(position);
    }
    if (relative_miss(quads, options.quads) <= kCloseEnough) return;
    calibration.observe(quads);
  }
}

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  check(options);
  check_raster(picture);
  const double width = picture.width, height = picture.height;
  // Faces are extracted at twice the wished edge length; dividing each of them halves it.
  const double edge = 2 * std::sqrt(width * height / options.quads);
  Quadrangulation result;
  const bool has_room = 2 * edge <= std::min(width, height) * kRoundingSlack;
  if (has_room && !options.lattice) {
    StageClock clock(context);
    result.working = make_working_picture(picture, edge);
    result.features = feature_tensor(result.working.picture, {}, context);
    clock.finish("features");
    result.cross = cross_field(result.features, options.cross_field, context);
    clock.finish("cross field",
                 {{"singularities", static_cast<double>(singularities(result.cross).size())}});
    mesh_to_count(result, width, height, edge, options, clock, context);
    snap_to_features(result.mesh, picture, options.snap, context);
    clock.finish("snapping");
  }
  const bool valid = result.mesh.quad_count() > 0 && validate(result.mesh, width, height).empty();
  if (!valid) {
    result.mesh = lattice_mesh(width, height, options.quads);
    result.fallback = !options.lattice;
  }
  return result;
}

}  // namespace quadrille
