#include "patch_fitting.h"

#include <cmath>
#include <utility>

#include "quadrille/patch_geometry.h"
#include "reduced_picture.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

// Pixels per patch on which vertices are moved, and the reduction of both sides that is worth it.
constexpr double kEnoughPixels = 50, kWorthwhile = 1.4;

bool moves_vertices(const FitOptions& fit, const OptimizeOptions& optimize) {
  return optimize.rounds > 0 && fit.method != FitMethod::bessel;
}

FittedPatches fit_at_full_size(QuadMesh mesh, const Raster& picture, const FitOptions& fit,
                               const OptimizeOptions& optimize, const RunContext& context) {
  StageClock clock(context);
  FittedPatches result;
  PatchMesh& patches = result.patches;
  patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  guard_folds(patches);
  clock.finish("patches");
  const bool moves = moves_vertices(fit, optimize);
  result.fit = fit_colors(patches, picture, moves ? draft_options(fit) : fit, context);
  clock.finish("colours", {{"iterations", result.fit.iterations}});
  result.optimized = optimize_vertices(patches, picture, optimize, fit, context);
  if (moves && result.optimized.accepted == 0) {
    result.fit = fit_colors(patches, picture, fit, context);
  }
  clock.finish("vertices", {{"rounds", result.optimized.rounds.size()},
                            {"accepted", result.optimized.accepted}});
  return result;
}

}  // namespace

FittedPatches fitted_patches(QuadMesh mesh, const Raster& picture, const FitOptions& fit,
                             const OptimizeOptions& optimize, const RunContext& context) {
  const double pixels = static_cast<double>(picture.width) * picture.height;
  const double reduction = std::sqrt(pixels / mesh.quad_count() / kEnoughPixels);
  if (!moves_vertices(fit, optimize) || reduction < kWorthwhile) {
    return fit_at_full_size(std::move(mesh), picture, fit, optimize, context);
  }
  const Raster small = reduced_picture(picture, reduction);
  const Eigen::Array2d scale(static_cast<double>(small.width) / picture.width,
                             static_cast<double>(small.height) / picture.height);
  std::vector<Eigen::Vector2d> start = mesh.vertices;
  for (Eigen::Vector2d& v : start) v = v.array() * scale;
  QuadMesh small_mesh = mesh;
  small_mesh.vertices = start;
  FittedPatches result = fit_at_full_size(std::move(small_mesh), small, fit, optimize, context);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector2d& now = result.patches.mesh.vertices[v];
    // By coordinate, so that vertices stay exactly on a side along which they slide.
    for (int axis = 0; axis < 2; ++axis) {
      if (now[axis] != start[v][axis]) mesh.vertices[v][axis] = now[axis] / scale[axis];
    }
  }
  StageClock clock(context);
  result.patches = fit_patches(std::move(mesh), picture, fit, context);
  clock.finish("colours at full size");
  return result;
}

}  // namespace quadrille
