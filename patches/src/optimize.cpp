#include "quadrille/optimize.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "fitted_state.h"
#include "joint_system.h"
#include "limit_overshoot.h"
#include "parallel_ranges.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "shape_energy.h"
#include "vertex_steps.h"

namespace quadrille {
namespace {

constexpr double kFirstDamping = 0.3, kDampingOnSuccess = 0.4, kDampingOnFailure = 5;
/// Shape energy in units of a mean quad's pixels times the root of the mean squared error; with it
/// quads come out equally well shaped in calm and in busy pictures.
constexpr double kShapeScale = 0.16;
/// The colours of a round need not be better than its step.
constexpr double kRoundTolerance = 0.2;

void check_shapes(const QuadMesh& mesh) {
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (!std::isfinite(shape_energy(mesh, q))) {
      throw Error(ErrorCode::invalid_argument,
                  "quad " + std::to_string(q) +
                      " is not strictly convex, so its vertices cannot be optimised; pass a mesh "
                      "that validate() finds nothing wrong with");
    }
  }
}

PatchMesh moved(const FittedState& state, const JointVector& step, const VertexGuides& guides,
                double least) {
  PatchMesh patches = state.patches;
  patches.mesh.vertices = take_steps(state.patches.mesh, guides, step.moves, least);
  set_bessel_tangents(patches);
  guard_folds(patches);
  add_correction(step.colors, patches.wedges);
  return patches;
}

double cost(const FittedState& state, double shape_weight) {
  return state.squared_error + state.roughness + shape_weight * shape_energy(state.patches.mesh);
}

/// Forwards cancellation and the completed share of all rounds.
RunContext rounds_context(const RunContext& context, const double& done, double share) {
  RunContext inner;
  inner.threads = context.threads;
  inner.on_progress = [&context, &done, share](const std::string&, double fraction) {
    context.progress("vertices", done + share * fraction);
    return true;
  };
  return inner;
}

OptimizeReport take_rounds(PatchMesh& patches, const Raster& picture,
                           const OptimizeOptions& options, const FitOptions& fit,
                           const RunContext& context) {
  double done = 0;
  const double share = 1.0 / (options.rounds + 1);
  const RunContext inner = rounds_context(context, done, share);
  FitOptions round_fit = fit;
  round_fit.tolerance = std::max(fit.tolerance, kRoundTolerance);

  auto state = std::make_unique<FittedState>(patches, picture, draft_options(fit), inner);
  std::size_t sample_count = 0;
  for (const SampleBlock& block : state->samples) sample_count += block.pixel.size();
  OptimizeReport report;
  if (sample_count == 0) return report;
  const double values = static_cast<double>(sample_count) * picture.channels;
  report.mse_before = report.mse_after = state->squared_error / values;
  const double weight = options.shape_weight * kShapeScale * std::sqrt(report.mse_before) *
                        static_cast<double>(sample_count) / patches.patch_count();
  std::optional<VertexGuides> guides;
  std::optional<JointSystem> system;
  double damping = kFirstDamping;
  while (static_cast<int>(report.rounds.size()) < options.rounds) {
    done = share * static_cast<double>(report.rounds.size() + 1);
    if (!system) {
      guides.emplace(state->patches);
      system.emplace(state->colors, state->patches, state->samples, picture, state->mean, *guides,
                     weight);
    }
    OptimizeRound round;
    JointVector step;
    round.joint_iterations = system->solve(damping, step);
    auto next = std::make_unique<FittedState>(
        moved(*state, step, *guides, options.min_scaled_jacobian), picture, round_fit, inner);
    round.color_iterations = next->fit.iterations;
    round.accepted = cost(*next, weight) < cost(*state, weight);
    if (round.accepted) {
      system.reset();
      state = std::move(next);
      round.mse = state->squared_error / values;
      ++report.accepted;
    }
    damping *= round.accepted ? kDampingOnSuccess : kDampingOnFailure;
    report.rounds.push_back(round);
  }
  if (report.accepted == 0) return report;
  state->improve(picture, draft_options(fit), inner);
  report.mse_after = state->squared_error / values;
  report.fit = state->fit;
  patches = std::move(state->patches);
  return report;
}

}  // namespace

void check_options(const OptimizeOptions& options) {
  const auto reject = [](const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
  };
  if (options.rounds < 0) {
    reject("the optimisation was asked for " + std::to_string(options.rounds) +
           " rounds; use 0 or more");
  }
  if (!(options.shape_weight >= 0) || !std::isfinite(options.shape_weight)) {
    reject("the optimisation's shape weight is " + std::to_string(options.shape_weight) +
           "; use a number such as 0.02");
  }
  if (!(options.min_scaled_jacobian > 0 && options.min_scaled_jacobian < 1)) {
    reject("the optimisation's smallest scaled Jacobian is " +
           std::to_string(options.min_scaled_jacobian) + "; use a number between 0 and 1");
  }
}

OptimizeReport optimize_vertices(PatchMesh& patches, const Raster& picture,
                                 const OptimizeOptions& options, const FitOptions& fit,
                                 const RunContext& context) {
  check_options(options);
  check_fit(patches, picture, fit);
  OptimizeReport report;
  if (options.rounds == 0 || fit.method == FitMethod::bessel) return report;
  check_shapes(patches.mesh);
  tbb::task_arena arena(arena_size(context));
  arena.execute([&] {
    report = take_rounds(patches, picture, options, fit, context);
    if (report.accepted > 0 && fit.method == FitMethod::hermite) {
      FitOptions last = draft_options(fit);
      last.max_overshoot = fit.max_overshoot;
      const double done = 1;
      limit_overshoot(patches, picture, last, rounds_context(context, done, 0), report.fit);
    }
  });
  if (report.accepted > 0 && fit.method != FitMethod::hermite) {
    report.fit = fit_colors(patches, picture, fit, context);
  }
  return report;
}

}  // namespace quadrille
