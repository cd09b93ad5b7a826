#include "overshoot.h"

#include <gtest/gtest.h>

#include <limits>

#include "quadrille/error.h"
#include "quadrille/fit.h"
#include "quadrille/patch_geometry.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using namespace testing;
using Eigen::Array4d;

constexpr int kSize = 40;
constexpr double kAllowed = 0.005;

FitOptions with_bound(double max_overshoot) {
  FitOptions options;
  options.max_overshoot = max_overshoot;
  return options;
}

/// How far the patches' colours leave [least, most] at 9 x 9 places each.
double farthest_outside(const PatchMesh& patches, double least, double most) {
  double farthest = 0;
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    for (int i = 0; i < 81; ++i) {
      const Color color = patch.color.at(i % 9 / 8.0, i / 9 / 8.0);
      for (int c = 0; c < 3; ++c) {
        farthest = std::max({farthest, least - static_cast<double>(color[c]),
                             static_cast<double>(color[c]) - most});
      }
    }
  }
  return farthest;
}

TEST(Overshoot, LinearColoursAreWithinTheirRangeUpToThePicturesSides) {
  SplitMesh split = split_mesh(8, 8, kSize, kSize, 17.3, 24.8);
  tear(split.mesh, split.line);
  const Raster picture = paint_box_filtered(kSize, kSize, 3, 16, [](double x, double y) -> Array4d {
    return {0.02 * x, 0.9 - 0.02 * y, 0.01 * (x + y), 1};
  });
  const PatchMesh patches = fit_patches(split.mesh, picture);
  EXPECT_FALSE(Overshoot().find(patches, picture, 1e-3));
}

/// Two colours that meet along a zigzag, torn along the straight line through its middle: what the
/// mixed pixels leave open then explains the teeth.
TEST(Overshoot, TheBoundLowersWhatATearThatMissesItsEdgeLeavesOpen) {
  const auto is_left = [](double x, double y) {
    const double tooth = std::abs(y / 4 - std::floor(y / 4) - 0.5);
    return x < 20 + 2 * (tooth - 0.25);
  };
  const double least = 0.2, most = 0.8;
  const Raster picture = paint_box_filtered(kSize, kSize, 3, 16, [&](double x, double y) {
    const double c = is_left(x, y) ? least : most;
    return Array4d(c, c, c, 1);
  });
  SplitMesh split = split_mesh(20, 20, kSize, kSize, 20, 20);
  tear(split.mesh, split.line);
  const double free = farthest_outside(
      fit_patches(split.mesh, picture, with_bound(std::numeric_limits<double>::infinity())), least,
      most);
  const double bound =
      farthest_outside(fit_patches(split.mesh, picture, with_bound(kAllowed)), least, most);
  EXPECT_GT(free, 10 * kAllowed);
  EXPECT_LT(bound - kAllowed, 0.7 * (free - kAllowed));
}

TEST(Overshoot, ABoundThatIsNotReachedChangesNothing) {
  const Raster picture = paint_box_filtered(kSize, kSize, 3, 4, [](double x, double y) -> Array4d {
    return {0.5 + 0.3 * std::sin(x / 9), 0.4, 0.5 + 0.2 * std::cos(y / 7), 1};
  });
  const QuadMesh mesh = lattice(6, 6, kSize, kSize);
  const PatchMesh free = fit_patches(mesh, picture);
  const PatchMesh bound = fit_patches(mesh, picture, with_bound(1));
  for (std::size_t w = 0; w < free.wedges.size(); ++w) {
    EXPECT_TRUE((free.wedges[w].value == bound.wedges[w].value).all());
    EXPECT_TRUE((free.wedges[w].dx == bound.wedges[w].dx).all());
  }
}

TEST(Overshoot, OptionsOutsideTheirRangeAreRefused) {
  EXPECT_NO_THROW(check_options(with_bound(0)));
  EXPECT_THROW(check_options(with_bound(-0.1)), Error);
  EXPECT_THROW(check_options(with_bound(std::numeric_limits<double>::quiet_NaN())), Error);
}

}  // namespace
}  // namespace quadrille
