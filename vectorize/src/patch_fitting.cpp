#include "patch_fitting.h"

#include <cmath>
#include <utility>

#include "quadrille/patch_geometry.h"
#include "reduced_picture.h"
#include "stage_clock.h"

namespace quadrille {
namespace {

// Pixels per patch on which vertices are moved: with more the errors of 600 quads on photographs
// did not fall. Then the reduction of both sides that is worth it.
constexpr double kEnoughPixels = 100, kWorthwhile = 1.4;

PatchMesh curved_patches(QuadMesh mesh) {
  PatchMesh patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  guard_folds(patches);
  return patches;
}

/// Moves the vertices; its first fit starts from sampled colours.
OptimizeReport move_vertices(PatchMesh& patches, const Raster& picture, const FitOptions& fit,
                             const OptimizeOptions& optimize, StageClock& clock,
                             const RunContext& context) {
  fit_colors(patches, picture, {.method = FitMethod::bessel}, context);
  OptimizeReport report = optimize_vertices(patches, picture, optimize, fit, context);
  clock.finish("vertices", {{"rounds", report.rounds.size()}, {"accepted", report.accepted}});
  return report;
}

double reduction_for(const QuadMesh& mesh) {
  double area = 0;
  for (int q = 0; q < mesh.quad_count(); ++q) area += std::abs(quad_area(mesh, q));
  return std::sqrt(area / mesh.quad_count() / kEnoughPixels);
}

/// Vertices of the picture in a reduced one and back; both know what lies on a far side.
class Reduction {
 public:
  Reduction(const Raster& from, const Raster& to)
      : from_(from.width, from.height), to_(to.width, to.height) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& v) const { return scaled(v, from_, to_); }
  Eigen::Vector2d back(const Eigen::Vector2d& v) const { return scaled(v, to_, from_); }

 private:
  Eigen::Vector2d from_, to_;

  static Eigen::Vector2d scaled(const Eigen::Vector2d& v, const Eigen::Vector2d& from,
                                const Eigen::Vector2d& to) {
    Eigen::Vector2d result;
    for (int axis = 0; axis < 2; ++axis) {
      result[axis] = v[axis] == from[axis] ? to[axis] : v[axis] * (to[axis] / from[axis]);
    }
    return result;
  }
};

/// Moves the mesh's vertices on a picture reduced by the factor.
OptimizeReport move_on_reduced(QuadMesh& mesh, const Raster& picture, double factor,
                               const FitOptions& fit, const OptimizeOptions& optimize,
                               StageClock& clock, const RunContext& context) {
  const Raster small = reduced_picture(picture, factor);
  const Reduction reduced(picture, small);
  QuadMesh start = mesh;
  for (Eigen::Vector2d& v : start.vertices) v = reduced(v);
  PatchMesh patches = curved_patches(start);
  OptimizeReport report =
      move_vertices(patches, small, draft_options(fit), optimize, clock, context);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector2d &before = start.vertices[v], &now = patches.mesh.vertices[v];
    const Eigen::Vector2d moved = reduced.back(now);
    // By coordinate, so that vertices stay exactly on a side along which they slide.
    for (int axis = 0; axis < 2; ++axis) {
      if (now[axis] != before[axis]) mesh.vertices[v][axis] = moved[axis];
    }
  }
  return report;
}

}  // namespace

FittedPatches fitted_patches(QuadMesh mesh, const Raster& picture, const FitOptions& fit,
                             const OptimizeOptions& optimize, const RunContext& context) {
  StageClock clock(context);
  FittedPatches result;
  const bool moves = optimize.rounds > 0 && fit.method != FitMethod::bessel;
  const double reduction = reduction_for(mesh);
  const bool reduces = moves && reduction >= kWorthwhile;
  if (reduces) {
    result.optimized = move_on_reduced(mesh, picture, reduction, fit, optimize, clock, context);
  }
  result.patches = curved_patches(std::move(mesh));
  clock.finish("patches");
  if (moves && !reduces) {
    result.optimized = move_vertices(result.patches, picture, fit, optimize, clock, context);
    result.fit = result.optimized.fit;
  }
  if (reduces || result.optimized.accepted == 0) {
    result.fit = fit_colors(result.patches, picture, fit, context);
    clock.finish("colours", {{"iterations", result.fit.iterations}});
  }
  return result;
}

}  // namespace quadrille
