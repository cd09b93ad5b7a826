#include "pdf_shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "paintable_patch.h"
#include "patch_opacity.h"
#include "pdf_records.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using test::Painted;
using test::ReadPatch;

constexpr double kSize = 48;

bool has_corner(const ReadPatch& patch, const Vector2d& p, double within) {
  return std::ranges::any_of(std::array{0, 3, 6, 9},
                             [&](int k) { return (patch.points[k] - p).norm() <= within; });
}

TEST(PdfShading, RecordsGiveBackThePatchesPointsAndColors) {
  PatchMesh patches = testing::random_patches(3, 3, kSize, kSize, 4);
  testing::set_linear_colors(patches, Color(0.5f, 0.25f, 0.75f, 1));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  const Layer& layer = image.layers[0];
  Painted painted(layer, 2);
  const std::vector<ReadPatch> read = painted.read();
  // Patches of one colour are one cell each. Four corners, and the curves between them, lie where
  // the patch's do, but for what patches overlap and go on beyond the page, and the grid's half
  // step.
  constexpr double kWithin = 1.5;
  for (int q = 0; q < layer.patches.patch_count(); ++q) {
    const BicubicBezier<Vector2d> bezier = to_bezier(placed_geometry(layer, q));
    const auto is_this = [&](const ReadPatch& patch) {
      return std::ranges::all_of(std::array{0, 1, 2, 3}, [&](int side) {
        return has_corner(patch, side_curve(bezier, side)[0], kWithin);
      });
    };
    const auto found = std::ranges::find_if(read, is_this);
    ASSERT_NE(found, read.end()) << q;
    for (int side = 0; side < 4; ++side) {
      const Vector2d middle = bezier.at(side == 1   ? 1
                                        : side == 3 ? 0
                                                    : 0.5,
                                        side == 0   ? 0
                                        : side == 2 ? 1
                                                    : 0.5);
      double nearest = kSize;
      for (int k = 0; k < 12; k += 3) {
        const auto& p = found->points;
        const Vector2d at = (p[k] + 3 * p[k + 1] + 3 * p[k + 2] + p[(k + 3) % 12]) / 8;
        nearest = std::min(nearest, (at - middle).norm());
      }
      EXPECT_LE(nearest, kWithin) << q << ' ' << side;
    }
    for (const auto& color : found->colors) {
      EXPECT_NEAR(color[0], 127.5, 1);
      EXPECT_NEAR(color[1], 63.75, 1);
      EXPECT_NEAR(color[2], 191.25, 1);
    }
  }
}

TEST(PdfShading, ACurvedPatchInsideKeepsItsControlPointsToTheGrid) {
  PatchMesh patches = testing::random_patches(3, 3, kSize, kSize, 7);
  testing::set_linear_colors(patches, Color(0.5f, 0.5f, 0.5f, 1));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  Painted painted(image.layers[0], 2);
  const std::vector<ReadPatch> read = painted.read();
  // The overlap of a 16th and half a step of the grid in both directions.
  constexpr double kWithin = 0.25;
  const BicubicBezier<Vector2d> bezier = to_bezier(placed_geometry(image.layers[0], 4));
  int all = 0;
  for (const ReadPatch& patch : read) {
    int near = 0;
    for (int side = 0; side < 4; ++side) {
      for (int k = 0; k < 3; ++k) {
        const Vector2d p = side_curve(bezier, side)[k];
        near += std::ranges::any_of(patch.points,
                                    [&](const Vector2d& o) { return (o - p).norm() <= kWithin; });
      }
    }
    all += near == 12;
  }
  EXPECT_EQ(all, 1);
}

TEST(PdfShading, AnUnderlayHasThePatchesColors) {
  PatchMesh patches = straight_patches(testing::lattice(8, 8, kSize, kSize));
  testing::set_linear_colors(patches, Color(0, 0.5f, 1, 1), Color(1.0f / kSize, 0, 0, 0));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  const Underlay underlay = Painted(image.layers[0], 2).layer.parts.at(0).underlay;
  ASSERT_EQ(underlay.width, 8);
  ASSERT_EQ(underlay.height, 8);
  for (int x = 0; x < 8; ++x) {
    const auto red = static_cast<std::uint8_t>(underlay.rgb[3 * (3 * 8 + x)]);
    EXPECT_NEAR(red, 255 * (x + 0.5) / 8, 2) << x;
  }
}

TEST(PdfShading, WhatIsNotFiniteOrTooFarIsNotPainted) {
  for (const double far : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e12}) {
    PatchMesh patches = straight_patches(testing::lattice(4, 4, kSize, kSize));
    testing::set_linear_colors(patches, Color(1, 0, 0, 1));
    patches.mesh.vertices[12] = Vector2d(far, far);
    const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
    const Layer& layer = image.layers[0];
    const std::vector<PatchOpacity> opacity =
        paint_opacities(layer.patches, 0.01, paintable_patches(layer));
    EXPECT_EQ(std::ranges::count(opacity, PatchOpacity::transparent), 4);
    Painted painted(layer, 2);
    EXPECT_LE(painted.layer.grid.largest(0), 1e4);
    EXPECT_GE(painted.layer.grid.origin.x(), -16);
  }
}

}  // namespace
}  // namespace quadrille
