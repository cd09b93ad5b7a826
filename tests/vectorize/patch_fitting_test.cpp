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
    const Raster picture = rings(301, 224, channels);
    // 600 pixels a patch, and too few to reduce the picture.
    const QuadMesh mesh = testing::lattice(12, 9, 301, 224);
    OptimizeOptions still;
    still.rounds = 0;
    const double unmoved = error_of(fitted_patches(mesh, picture, {}, still, {}), picture);
    const FittedPatches coarse = fitted_patches(mesh, picture, {}, {}, {});
    PatchMesh fine = fit_patches(mesh, picture);
    optimize_vertices(fine, picture);
    const double exact = error_of({fine, {}, {}}, picture);
    EXPECT_GT(coarse.optimized.accepted, 0);
    EXPECT_TRUE(validate(coarse.patches.mesh, 301, 224).empty());
    EXPECT_LT(error_of(coarse, picture), 0.8 * unmoved);
    EXPECT_LT(error_of(coarse, picture), 1.1 * exact);
  }
}

TEST(FittedPatches, OfFewPixelsAreMovedOnThePictureItself) {
  const Raster picture = rings(120, 90, 3);
  const QuadMesh mesh = testing::lattice(15, 11, 120, 90);
  PatchMesh expected = fit_patches(mesh, picture, draft_options({}));
  optimize_vertices(expected, picture);
  const FittedPatches fitted = fitted_patches(mesh, picture, {}, {}, {});
  EXPECT_EQ(fitted.patches.mesh.vertices, expected.mesh.vertices);
}

}  // namespace
}  // namespace quadrille
