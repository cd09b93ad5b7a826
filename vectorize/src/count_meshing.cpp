#include "count_meshing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "count_calibration.h"
#include "density_map.h"
#include "meshed_region.h"
#include "quadrille/mesh_region.h"

namespace quadrille {
namespace {

constexpr int kCalibrationRounds = 24;  // one or two for most pictures
// Cells asked for over cells made where the scale is graded: points too close to each other merge.
constexpr double kGradingLoss = 1.1;

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

QuadMesh extract(const Quadrangulation& fields, const ScaleField& scale,
                 const PositionField& position, const Raster& picture, const RunContext& context) {
  if (fields.outline.empty()) {
    return extract_quads(fields.features, fields.cross, scale, position, fields.chains,
                         picture.width, picture.height, context);
  }
  return extract_quads(fields.features, fields.cross, scale, position, fields.outline,
                       picture.width, picture.height, context);
}

struct Attempt {
  double cells = 0, miss = 0;
  bool valid = false;
  ScaleField scale;
  PositionField position;
  QuadMesh mesh;

  bool is_better_than(const Attempt& other) const {
    return valid != other.valid ? valid : miss < other.miss;
  }
};

}  // namespace

double relative_miss(int quads, int wished) {
  return std::abs(static_cast<double>(quads) - wished) / wished;
}

bool is_valid(const QuadMesh& mesh, const std::vector<Loop>& outline, const Raster& picture) {
  if (mesh.quad_count() == 0) return false;
  const auto violations = outline.empty() ? validate(mesh, picture.width, picture.height)
                                          : validate_region(mesh, picture.width, picture.height);
  return violations.empty();
}

FieldGrid<float> wished_density(const Quadrangulation& fields, const VectorizeOptions& options) {
  if (options.density.data.empty()) return {};
  return density_map(options.density, fields.cross.z.width, fields.cross.z.height);
}

void mesh_to_count(Quadrangulation& fields, const Raster& picture, double edge,
                   const VectorizeOptions& options, const CountWish& wish, StageClock& clock,
                   const RunContext& context) {
  ScaleOptions scale_options = options.scale;
  if (!wish.density.data.empty()) scale_options.density = wish.density;
  const ScaleField relative = relative_scale(fields.features, fields.cross,
                                             edge / fields.working.scale_x, scale_options, context);
  const bool whole = fields.outline.empty();
  const double share = whole ? 1 : share_of_cells(fields.outline, fields.working, relative);
  // Along an outline vertices are added about as often as points merge where the scale is graded.
  const double loss = whole && has_features(fields.features) ? kGradingLoss : 1;
  CountCalibration calibration(options.quads,
                               wish.first_guess.value_or(options.quads / 4.0 * loss / share));
  const int rounds = whole ? kCalibrationRounds : kOutlineRounds;
  std::optional<Attempt> best;
  for (int round = 0; round < rounds; ++round) {
    Attempt attempt;
    attempt.cells = calibration.cells();
    attempt.scale = scaled_to_count(relative, fields.cross, attempt.cells, side_fit(round));
    clock.finish("scale field");
    attempt.position =
        position_field(fields.features, fields.cross, attempt.scale, options.position, context);
    clock.finish("position field");
    attempt.mesh = extract(fields, attempt.scale, attempt.position, picture, context);
    attempt.valid = is_valid(attempt.mesh, fields.outline, picture);
    attempt.miss = relative_miss(attempt.mesh.quad_count(), options.quads);
    clock.finish("quads", {{"asked", std::round(4 * share * attempt.cells)},
                           {"quads", static_cast<double>(attempt.mesh.quad_count())}});
    calibration.observe(attempt.mesh.quad_count());
    if (!best || attempt.is_better_than(*best)) best = std::move(attempt);
    if (best->valid && best->miss <= wish.tolerance) break;
  }
  fields.mesh = std::move(best->mesh);
  fields.scale = std::move(best->scale);
  fields.position = std::move(best->position);
  fields.lattice_cells = best->cells;
}

}  // namespace quadrille
