#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "quadrille/error.h"
#include "quadrille/vectorize.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

constexpr int kCalibrationRounds = 4;
constexpr double kCloseEnough = 0.05;  // of the wished count
// Cells asked for over cells made where the scale is graded: points too close to each other merge.
constexpr double kGradingLoss = 1.13;
// Lattice edges shorter than this, in source pixels, carry no information about the picture.
constexpr double kShortestEdge = 1.0;

void check(const VectorizeOptions& options) {
  if (options.quads < 1) {
    throw Error(ErrorCode::invalid_argument,
                "the number of quads is " + std::to_string(options.quads) + "; ask for at least 1");
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

}  // namespace

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              const RunContext& context) {
  check(options);
  const double width = picture.width, height = picture.height;
  // Faces are extracted at twice the wished edge length; dividing each of them halves it.
  const double edge = 2 * std::sqrt(width * height / options.quads);
  Quadrangulation result;
  if (options.lattice || edge < 2 * kShortestEdge) {
    result.mesh = lattice_mesh(width, height, options.quads);
    result.fallback = !options.lattice;
    return result;
  }
  StageClock clock(context);
  result.working = make_working_picture(picture, edge);
  result.features = feature_tensor(result.working.picture, {}, context);
  clock.finish("features");
  result.cross = cross_field(result.features, options.cross_field, context);
  clock.finish("cross field");

  std::optional<QuadMesh> best;
  const bool graded = std::any_of(result.features.edges.data.begin(),
                                  result.features.edges.data.end(), [](auto e) { return e != 0; });
  CountCalibration calibration(options.quads, options.quads / 4.0 * (graded ? kGradingLoss : 1));
  for (int round = 0; round < kCalibrationRounds; ++round) {
    ScaleField scale =
        scale_field(result.features, result.cross, calibration.cells(), options.scale, context);
    clock.finish("scale field");
    PositionField position =
        position_field(result.features, result.cross, scale, options.position, context);
    clock.finish("position field");
    QuadMesh mesh =
        extract_quads(result.features, result.cross, scale, position, width, height, context);
    clock.finish("quads", {{"wished", 4 * calibration.cells()},
                           {"quads", static_cast<double>(mesh.quad_count())}});
    const int quads = mesh.quad_count();
    if (!best ||
        relative_miss(quads, options.quads) < relative_miss(best->quad_count(), options.quads)) {
      best = std::move(mesh);
      result.scale = std::move(scale);
      result.position = std::move(position);
    }
    if (relative_miss(quads, options.quads) <= kCloseEnough) break;
    calibration.observe(quads);
  }
  result.mesh = std::move(*best);
  return result;
}

}  // namespace quadrille
