#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"
#include "quadrille/vectorize.h"
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

/// Scales, positions and quads for the solved cross field, repeated with corrected scales until the
/// count is close to the wished one; keeps the closest.
void mesh_to_count(Quadrangulation& result, double width, double height,
                   const VectorizeOptions& options, StageClock& clock, const RunContext& context) {
  CountCalibration calibration(
      options.quads, options.quads / 4.0 * (has_features(result.features) ? kGradingLoss : 1));
  for (int round = 0; round < kCalibrationRounds; ++round) {
    ScaleField scale =
        scale_field(result.features, result.cross, calibration.cells(), options.scale, context);
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

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  check(options);
  check_raster(picture);
  const double width = picture.width, height = picture.height;
  // Faces are extracted at twice the wished edge length; dividing each of them halves it.
  const double edge = 2 * std::sqrt(width * height / options.quads);
  Quadrangulation result;
  const bool meaningful =
      edge >= 2 * kShortestEdge && 2 * edge <= std::min(width, height) * kRoundingSlack;
  if (meaningful && !options.lattice) {
    StageClock clock(context);
    result.working = make_working_picture(picture, edge);
    result.features = feature_tensor(result.working.picture, {}, context);
    clock.finish("features");
    result.cross = cross_field(result.features, options.cross_field, context);
    clock.finish("cross field", phase_figures(result.cross));
    mesh_to_count(result, width, height, options, clock, context);
  }
  const bool valid = result.mesh.quad_count() > 0 &&
                     relative_miss(result.mesh.quad_count(), options.quads) <= kAcceptableMiss &&
                     validate(result.mesh, width, height).empty();
  if (!valid) {
    result.mesh = lattice_mesh(width, height, options.quads);
    result.fallback = !options.lattice;
  }
  return result;
}

}  // namespace quadrille
