#include "quadrille/optimize.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "fit_solver.h"
#include "joint_system.h"
#include "parallel_ranges.h"
#include "picture_sampling.h"
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
constexpr double kRoundTolerance = 3e-2;

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

double total_shape_energy(const QuadMesh& mesh) {
  return sum_over_ranges(mesh.quad_count(), 0.0, [&](int begin, int end) {
    double sum = 0;
    for (int q = begin; q < end; ++q) sum += shape_energy(mesh, q);
    return sum;
  });
}

/// Patches with the colours that fit best, and how well they do.
class State {
 public:
  /// The colours that the patches have are improved upon, or kept where `solved`.
  State(PatchMesh start, bool solved, const Raster& picture, const FitOptions& fit,
        const RunContext& context)
      : patches(std::move(start)), colors(patches, picture, fit, context, &samples) {
    ColorSystem::Vector correction(patches.wedges.size(), WedgeUnknowns::Zero());
    if (!solved) {
      FitReport report;
      correction = quadrille::solve(colors, fit, context, report);
      add_correction(correction, patches.wedges);
      iterations = report.iterations;
    }
    show(picture, correction);
    shape_energy = total_shape_energy(patches.mesh);
  }

  PatchMesh patches;
  std::vector<SampleBlock> samples;
  ColorSystem colors;
  Raster mean;  ///< of the picture and what the patches show, premultiplied
  int iterations = 0;
  double squared_error = 0, roughness = 0, shape_energy = 0;

  double cost(double shape_weight) const {
    return squared_error + roughness + shape_weight * shape_energy;
  }

 private:
  void show(const Raster& picture, const ColorSystem::Vector& correction);
  double show_patch(const SampleBlock& block, int local, const Raster& picture);
};

void State::show(const Raster& picture, const ColorSystem::Vector& correction) {
  mean = picture;
  if (picture.has_alpha()) {
    // Where no patch lies the picture stands for it.
    for (std::size_t i = 0; 4 * i < mean.data.size(); ++i) {
      const Color color = premultiplied_pixel(picture, i);
      for (int c = 0; c < 4; ++c) mean.data[4 * i + c] = color[c];
    }
  }
  std::vector<double> errors(samples.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t b) {
    for (int local = 0; local < samples[b].patch_count(); ++local) {
      errors[b] += show_patch(samples[b], local, picture);
    }
  });
  for (const double e : errors) squared_error += e;
  const std::vector<std::size_t>& mixed = colors.mixed_pixels().pixels();
  for (std::size_t row = 0; row < colors.rows().size(); ++row) {
    const Eigen::Vector4f rest = colors.rows().rest(row, correction);
    if (row >= mixed.size()) {
      roughness += static_cast<double>(rest.squaredNorm());
      continue;
    }
    const Color given = premultiplied_pixel(picture, mixed[row]);
    for (int c = 0; c < picture.channels; ++c) {
      float& between = mean.data[mixed[row] * picture.channels + c];
      const double at_center = 2 * (given[c] - between), now = rest[c];
      squared_error += now * now - at_center * at_center;
      between = given[c] - 0.5f * rest[c];
    }
  }
}

double State::show_patch(const SampleBlock& block, int local, const Raster& picture) {
  const int q = block.first_patch + local, channels = picture.channels;
  ControlColors model;
  control_colors(patches, q, corner_maps(patches, q), model);
  double error = 0;
  const std::size_t last = block.begin[local + 1];
  for (std::size_t first = block.begin[local]; first < last; first += FitBatch::kSize) {
    const int count = static_cast<int>(std::min<std::size_t>(FitBatch::kSize, last - first));
    alignas(64) float u[FitBatch::kSize] = {}, v[FitBatch::kSize] = {}, shown[4][FitBatch::kSize];
    std::copy_n(block.u.data() + first, count, u);
    std::copy_n(block.v.data() + first, count, v);
    evaluate_batch(model, channels, padded_count(count), u, v, shown);
    for (int i = 0; i < count; ++i) {
      const std::size_t pixel = block.pixel[first + i];
      float* const between = mean.data.data() + pixel * channels;
      float squares = 0;
      for (int c = 0; c < channels; ++c) {
        const float residual = between[c] - shown[c][i];
        squares += residual * residual;
        between[c] -= 0.5f * residual;
      }
      error += static_cast<double>(squares);
    }
  }
  return error;
}

PatchMesh moved(const State& state, const JointVector& step, const VertexGuides& guides,
                double least) {
  PatchMesh patches = state.patches;
  patches.mesh.vertices = take_steps(state.patches.mesh, guides, step.moves, least);
  set_bessel_tangents(patches);
  guard_folds(patches);
  add_correction(step.colors, patches.wedges);
  return patches;
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

  auto state = std::make_unique<State>(patches, true, picture, round_fit, inner);
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
    auto next = std::make_unique<State>(moved(*state, step, *guides, options.min_scaled_jacobian),
                                        false, picture, round_fit, inner);
    round.color_iterations = next->iterations;
    round.accepted = next->cost(weight) < state->cost(weight);
    if (round.accepted) {
      system.reset();
      state = std::move(next);
      round.mse = report.mse_after = state->squared_error / values;
      ++report.accepted;
    }
    damping *= round.accepted ? kDampingOnSuccess : kDampingOnFailure;
    report.rounds.push_back(round);
  }
  if (report.accepted > 0) patches = std::move(state->patches);
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
  arena.execute([&] { report = take_rounds(patches, picture, options, fit, context); });
  if (report.accepted > 0) report.fit = fit_colors(patches, picture, fit, context);
  return report;
}

}  // namespace quadrille
