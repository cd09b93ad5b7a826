#include "patch_fitting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

/// Soft rings and a sharp disc, with transparency beyond a circle where there is alpha.
Raster rings(int width, int height, int channels) {
  Raster picture(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double r = std::hypot(x + 0.5 - 0.45 * width, y + 0.5 - 0.55 * height);
      float* const pixel = picture.pixel(x, y);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = static_cast<float>(0.5 + 0.3 * std::sin(0.06 * r + c) + (r < 60 ? 0.2 : 0));
      }
      if (channels == 4) pixel[3] = static_cast<float>(1 / (1 + std::exp(0.1 * (r - 110))));
    }
  }
  return picture;
}

double error_of(const FittedPatches& fitted, const Raster& picture) {
  return compare(render(single_layer(fitted.patches, picture.width, picture.height)), picture).mae;
}

TEST(FittedPatches, MovesVerticesOnAReducedPictureAsWell) {
  for (const int channels : {3, 4}) {
    // A side of 107 pixels becomes one of 54, where 107 * (54 / 107) is less than 54.
    const Raster picture = rings(107, 224, channels);
    const QuadMesh mesh = testing::lattice(6, 9, 107, 224);  // 440 pixels a patch
    OptimizeOptions still;
    still.rounds = 0;
    const double unmoved = error_of(fitted_patches(mesh, picture, {}, still, {}), picture);
    const FittedPatches moved = fitted_patches(mesh, picture, {}, {}, {});
    EXPECT_GT(moved.optimized.accepted, 0);
    EXPECT_GT(moved.fit.iterations, 0);
    EXPECT_TRUE(validate(moved.patches.mesh, 107, 224).empty());
    EXPECT_LT(error_of(moved, picture), 0.85 * unmoved);
  }
}

/// Moved on the picture itself, from sampled colours.
PatchMesh moved_patches(const QuadMesh& mesh, const Raster& picture) {
  PatchMesh patches = fit_patches(mesh, picture, {.method = FitMethod::bessel});
  optimize_vertices(patches, picture);
  return patches;
}

TEST(FittedPatches, OfFewPixelsAreMovedOnThePictureItself) {
  const Raster picture = rings(120, 90, 3);
  const QuadMesh mesh = testing::lattice(15, 11, 120, 90);
  const FittedPatches fitted = fitted_patches(mesh, picture, {}, {}, {});
  EXPECT_EQ(fitted.patches.mesh.vertices, moved_patches(mesh, picture).mesh.vertices);
}

/// Patches are what counts: here they have few pixels in a large picture.
TEST(FittedPatches, OfASmallRegionAreMovedOnThePictureItself) {
  const Raster picture = rings(500, 400, 3);
  QuadMesh mesh = testing::lattice(15, 11, 120, 90);
  for (Eigen::Vector2d& v : mesh.vertices) v += Eigen::Vector2d(160, 150);
  EXPECT_EQ(fitted_patches(mesh, picture, {}, {}, {}).patches.mesh.vertices,
            moved_patches(mesh, picture).mesh.vertices);
}

TEST(FittedPatches, OfAReducedPictureAreTheSameForAnyNumberOfThreads) {
  const Raster picture = rings(300, 220, 3);
  QuadMesh mesh = testing::lattice(10, 8, 300, 220);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool is_row = mesh.vertices[mesh.origin(h)].y() == mesh.vertices[mesh.tip(h)].y();
    if (!mesh.is_border(e) && is_row && e % 3 == 0) mesh.edge_flags[e] = kTearEdge;
  }
  std::vector<PatchMesh> results;
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    results.push_back(fitted_patches(mesh, picture, {}, {}, context).patches);
    EXPECT_EQ(results.back().mesh.vertices, results.front().mesh.vertices);
    for (std::size_t w = 0; w < results.back().wedges.size(); ++w) {
      EXPECT_TRUE((results.back().wedges[w].value == results.front().wedges[w].value).all());
    }
  }
}

}  // namespace
}  // namespace quadrille
