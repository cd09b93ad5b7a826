#include "quadrille/fit.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fit_bessel.h"
#include "fit_bessel_system.h"
#include "fit_solver.h"
#include "fit_system.h"
#include "limit_overshoot.h"
#include "parallel_ranges.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"

namespace quadrille {
namespace {

// Of fits that are only compared with each other or made again.
constexpr double kDraftTolerance = 1e-2;
constexpr int kOvershootRounds = 2;

}  // namespace

FitOptions draft_options(FitOptions options) {
  options.tolerance = std::max(options.tolerance, kDraftTolerance);
  options.max_overshoot = std::numeric_limits<double>::infinity();
  return options;
}

void check_options(const FitOptions& options) {
  const auto reject = [](const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
  };
  if (!(options.regularization > 0) || !std::isfinite(options.regularization)) {
    reject("the fit's regularization is " + std::to_string(options.regularization) +
           "; use a small positive number such as 1e-4");
  }
  if (!(options.smoothness >= 0) || !std::isfinite(options.smoothness)) {
    reject("the fit's smoothness is " + std::to_string(options.smoothness) +
           "; use a length in pixels such as 0.2, or 0 for none");
  }
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    reject("the fit's tolerance is " + std::to_string(options.tolerance) +
           "; use a number between 0 and 1 such as 1e-4");
  }
  if (!(options.max_overshoot >= 0)) {
    reject("the fit's allowed overshoot is " + std::to_string(options.max_overshoot) +
           "; use a number from 0, or infinity for no bound");
  }
  if (options.max_iterations < 1) {
    reject("the fit was asked for at most " + std::to_string(options.max_iterations) +
           " iterations; use 1 or more");
  }
}

void check_fit(const PatchMesh& patches, const Raster& picture, const FitOptions& options) {
  if (patches.patch_count() == 0) {
    throw Error(ErrorCode::invalid_argument,
                "colours cannot be fitted to a mesh without patches; pass at least one quad");
  }
  check_raster(picture);
  check_options(options);
}

namespace {

FitReport correct_by_least_squares(PatchMesh& patches, const Raster& picture,
                                   const FitOptions& options, const RunContext& context,
                                   const Overshoot& overshoot = {}) {
  ColorSystem system(patches, picture, options, context, nullptr, overshoot);
  FitReport report;
  NormalEquations::Vector correction;
  if (options.method == FitMethod::bessel_ls) {
    BesselSystem restricted(system, patches);
    const auto samples = solve(restricted, options, context, report);
    correction.resize(samples.size());
    restricted.wedges_of(samples, correction);
  } else {
    correction = solve(system, options, context, report);
  }
  add_correction(correction, patches.wedges);
  return report;
}

}  // namespace

void limit_overshoot(PatchMesh& patches, const Raster& picture, const FitOptions& options,
                     const RunContext& context, FitReport& report) {
  if (std::isinf(options.max_overshoot)) return;
  RunContext quiet;  // the fit's own progress is complete
  quiet.threads = context.threads;
  quiet.on_progress = [&](const std::string&, double) {
    context.progress("fit", 1);
    return true;
  };
  Overshoot overshoot;
  for (int round = 0; round < kOvershootRounds; ++round) {
    if (!overshoot.find(patches, picture, options.max_overshoot)) return;
    const FitReport again = correct_by_least_squares(patches, picture, options, quiet, overshoot);
    report = {report.iterations + again.iterations, again.residual};
  }
}

FitReport fit_colors(PatchMesh& patches, const Raster& picture, const FitOptions& options,
                     const RunContext& context) {
  check_fit(patches, picture, options);
  FitReport report;
  tbb::task_arena arena(arena_size(context));
  arena.execute([&] {
    patches.opaque = !picture.has_alpha();
    patches.wedges = bessel_wedges(patches, picture);
    if (options.method != FitMethod::bessel) {
      report = correct_by_least_squares(patches, picture, options, context);
      limit_overshoot(patches, picture, options, context, report);
    }
  });
  context.progress("fit", 1);
  return report;
}

PatchMesh fit_patches(QuadMesh mesh, const Raster& picture, const FitOptions& options,
                      const RunContext& context) {
  PatchMesh patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  guard_folds(patches);
  fit_colors(patches, picture, options, context);
  return patches;
}

}  // namespace quadrille
