#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "inside_test.h"
#include "opaque_picture.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "quadrille/vectorize.h"
#include "region_features.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

constexpr int kCalibrationRounds = 4;
constexpr double kCloseEnough = 0.05;    // of the wished count
constexpr double kAcceptableMiss = 0.1;  // beyond it the lattice, which meets any count, is better
// Cells asked for over cells made where the scale is graded: points too close to each other merge.
constexpr double kGradingLoss = 1.13;
// Lets a picture of exactly 4 quads a side count as one.
constexpr double kRoundingSlack = 1 + 1e-9;
// Lattice edges shorter than this, in source pixels, carry no information about the picture.
constexpr double kShortestEdge = 1.0;
// Loops of an outline with fewer square pixels are specks and pinholes.
constexpr double kLeastLoopArea = 4;
// A loop takes some 8 quads at least, and half of the quads are to stay for the inside.
constexpr int kLeastQuadsPerLoop = 16;

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

/// The wished number of lattice cells that should give the wished number of quads, judged by the
/// last two rounds: count = constant * cells^exponent.
class CountCalibration {
 public:
  CountCalibration(int wished, double first_guess) : wished_(wished), cells_(first_guess) {}
  double cells() const { return cells_; }
  void observe(int quads) {
    double exponent = 1;
    if (last_quads_ > 0 && last_cells_ != cells_) {
      exponent = std::clamp(
          std::log(static_cast<double>(quads) / last_quads_) / std::log(cells_ / last_cells_), 0.6,
          1.6);
    }
    last_quads_ = quads;
    last_cells_ = cells_;
    cells_ *= std::pow(static_cast<double>(wished_) / quads, 1 / exponent);
  }

 private:
  int wished_;
  double cells_;
  int last_quads_ = 0;
  double last_cells_ = 0;
};

double relative_miss(int quads, int wished) {
  return std::abs(static_cast<double>(quads) - wished) / wished;
}

bool has_features(const FeatureTensor& features) {
  return std::any_of(features.edges.data.begin(), features.edges.data.end(),
                     [](unsigned char e) { return e != 0; });
}

/// Area of the part of the picture that is meshed.
double area_of(const Quadrangulation& result, const Raster& picture) {
  if (result.outline.empty()) return static_cast<double>(picture.width) * picture.height;
  double area = 0;
  for (const Loop& loop : result.outline) area += signed_area(loop);
  return area;
}

/// The share of the lattice's cells that lies inside the outline.
double share_of_cells(const Quadrangulation& result, const ScaleField& scale) {
  const InsideTest inside(result.outline);
  double all = 0, in_region = 0;
  for (int y = 0; y < scale.along_x.height; ++y) {
    for (int x = 0; x < scale.along_x.width; ++x) {
      const double cells = 1 / (static_cast<double>(scale.along_x(x, y)) * scale.along_y(x, y));
      all += cells;
      if (inside({(x + 0.5) * result.working.scale_x, (y + 0.5) * result.working.scale_y})) {
        in_region += cells;
      }
    }
  }
  // Of a tiny region no pixel may be inside.
  return std::max(in_region, 1.0) / all;
}

/// Scales, positions and quads for the solved cross field, repeated with corrected scales until the
/// count is close to the wished one; keeps the closest.
void mesh_to_count(Quadrangulation& result, const Raster& picture, const VectorizeOptions& options,
                   StageClock& clock, const RunContext& context) {
  const double width = picture.width, height = picture.height;
  // Along an outline vertices are added about as often as points merge where the scale is graded.
  const bool is_whole = result.outline.empty();
  double share = area_of(result, picture) / (width * height);
  const double wanted_cells =
      options.quads / 4.0 * (is_whole && has_features(result.features) ? kGradingLoss : 1);
  if (!is_whole) {
    share = share_of_cells(result, scale_field(result.features, result.cross, wanted_cells / share,
                                               options.scale, context));
  }
  CountCalibration calibration(options.quads, wanted_cells / share);
  for (int round = 0; round < kCalibrationRounds; ++round) {
    ScaleField scale =
        scale_field(result.features, result.cross, calibration.cells(), options.scale, context);
    clock.finish("scale field");
    PositionField position =
        position_field(result.features, result.cross, scale, options.position, context);
    clock.finish("position field");
    QuadMesh mesh = is_whole ? extract_quads(result.features, result.cross, scale, position, width,
                                             height, context)
                             : extract_quads(result.features, result.cross, scale, position,
                                             result.outline, width, height, context);
    const int quads = mesh.quad_count();
    clock.finish("quads", {{"asked", std::round(4 * share * calibration.cells())},
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

/// The outline to follow with so many quads: empty for the whole picture.
std::vector<Loop> wanted_outline(const Raster& picture, const VectorizeOptions& options) {
  if (options.region == MeshRegion::whole || !picture.has_alpha()) return {};
  std::vector<Loop> outline = alpha_outline(picture, kLeastLoopArea);
  if (outline.empty()) {
    throw Error(
        ErrorCode::degenerate_input,
        "the picture has no opaque pixel and so no outline; mesh the whole picture instead");
  }
  const std::size_t most = std::max(1, options.quads / kLeastQuadsPerLoop);
  if (outline.size() > most) {
    std::vector<double> areas;
    for (const Loop& loop : outline) areas.push_back(std::abs(signed_area(loop)));
    std::nth_element(areas.begin(), areas.begin() + most, areas.end(), std::greater<>());
    // A loop inside of another one is smaller, so what goes leaves nothing behind in it.
    outline = alpha_outline(picture, std::nextafter(areas[most], INFINITY));
  }
  if (is_frame(outline, picture.width, picture.height, kLeastLoopArea)) return {};
  return outline;
}

bool is_valid(const Quadrangulation& result, const Raster& picture) {
  if (result.mesh.quad_count() == 0) return false;
  const auto violations = result.outline.empty()
                              ? validate(result.mesh, picture.width, picture.height)
                              : validate_region(result.mesh, picture.width, picture.height);
  return violations.empty();
}

/// The lattice trimmed by the outline, with about the wished count.
QuadMesh trimmed_lattice(const std::vector<Loop>& outline, const Raster& picture, double area,
                         int wished) {
  CountCalibration calibration(wished, wished);
  QuadMesh best;
  for (int round = 0; round < kCalibrationRounds; ++round) {
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
  result.working = make_working_picture(whole ? picture : result.inside, edge);
  result.features = feature_tensor(result.working.picture, {}, context);
  if (!whole) confine_features(result.features, result.outline, result.working);
  clock.finish("features");
  result.cross = cross_field(result.features, options.cross_field, context);
  clock.finish("cross field",
               {{"singularities", static_cast<double>(singularities(result.cross).size())}});
  mesh_to_count(result, picture, options, clock, context);
}

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  check(options);
  check_raster(picture);
  Quadrangulation result;
  result.outline = wanted_outline(picture, options);
  const bool whole = result.outline.empty();
  if (!whole) result.inside = opaque_picture(picture);
  const double width = picture.width, height = picture.height;
  const double area = area_of(result, picture);
  // Faces are extracted at twice the wished edge length; dividing each of them halves it.
  const double edge = 2 * std::sqrt(area / options.quads);
  const bool meaningful =
      edge >= 2 * kShortestEdge && 2 * edge <= std::min(width, height) * kRoundingSlack;
  if (meaningful && !options.lattice) mesh_by_fields(result, picture, edge, options, context);

  // How few quads an outline can be followed with is not known, so any number will do there.
  const bool close_enough =
      !whole || relative_miss(result.mesh.quad_count(), options.quads) <= kAcceptableMiss;
  if (close_enough && is_valid(result, picture)) return result;
  result.fallback = !options.lattice;
  result.mesh = whole ? lattice_mesh(width, height, options.quads)
                      : trimmed_lattice(result.outline, picture, area, options.quads);
  if (!is_valid(result, picture)) {
    throw Error(ErrorCode::numerical_failure,
                "no valid mesh was found for the picture's outline; mesh the whole picture");
  }
  return result;
}

}  // namespace quadrille
