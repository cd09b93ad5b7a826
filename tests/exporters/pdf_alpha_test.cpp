#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

/// A picture of one colour per patch, torn along all edges between vertices at `x`.
VectorImage torn_picture(QuadMesh mesh, double x, const std::vector<Color>& colors) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool torn = mesh.vertices[mesh.origin(h)].x() == x && mesh.vertices[mesh.tip(h)].x() == x;
    if (torn) mesh.edge_flags[e] |= kTearEdge;
  }
  const double width = mesh.vertices.back().x(), height = mesh.vertices.back().y();
  PatchMesh patches = straight_patches(std::move(mesh));
  for (int corner = 0; corner < 4 * patches.patch_count(); ++corner) {
    patches.wedges[patches.wedge_of_corner[corner]].value = colors[corner / 4];
  }
  patches.opaque = false;
  return single_layer(std::move(patches), width, height);
}

/// By poppler, on white.
Raster drawn(const VectorImage& image, int scale) {
  const fs::path pdf = test::scratch_dir() / "alpha.pdf", stem = test::scratch_dir() / "alpha";
  export_image(image, pdf);
  EXPECT_EQ(
      test::run({"pdftoppm", "-png", "-singlefile", "-r", std::to_string(96 * scale), pdf, stem}),
      0);
  return load_image(stem.string() + ".png");
}

/// Two patches, the tear between them within pixels.
constexpr double kTear = 24.1;
VectorImage torn_pair(const Color& left, const Color& right) {
  QuadMesh mesh = testing::lattice(2, 1, 48, 16);
  for (auto& vertex : mesh.vertices) {
    if (vertex.x() == 24) vertex.x() = kTear;
  }
  return torn_picture(std::move(mesh), kTear, {left, right});
}

TEST(PdfAlpha, AcrossATearColorsAreWeightedByTheirAlpha) {
  constexpr double kFaint = 0.1;
  const VectorImage image =
      torn_pair(Color(1, 1, 1, 1), Color(0, 0, 0, static_cast<float>(kFaint)));
  for (const int scale : {1, 3, 4, 7}) {
    const Raster picture = drawn(image, scale);
    for (int x = 0; x < picture.width; ++x) {
      const double left = std::clamp(kTear * scale - x, 0.0, 1.0);
      EXPECT_NEAR(picture.pixel(x, picture.height / 2)[0], left + (1 - left) * (1 - kFaint), 0.03)
          << scale << ' ' << x;
    }
  }
}

TEST(PdfAlpha, AcrossATearBetweenTranslucentPatchesTheOneWithMoreAlphaPrevails) {
  const Color light(0.9f, 0.9f, 0.9f, 0.9f), shadow(0, 0, 0, 0.1f);
  for (const VectorImage& image : {torn_pair(light, shadow), torn_pair(shadow, light)}) {
    for (const int scale : {1, 3, 4, 7}) {
      const Raster picture = drawn(image, scale);
      // Over white, the one side is white, the other 10 % darker.
      for (int x = 0; x < picture.width; ++x) {
        EXPECT_GE(picture.pixel(x, picture.height / 2)[0], 0.86f) << scale << ' ' << x;
      }
    }
  }
}

TEST(PdfAlpha, WhatReachesBelowOpaquePatchesStaysOnItsSideOfATear) {
  constexpr double kSize = 48, kMiddle = 24;
  constexpr int kScale = 8;
  QuadMesh mesh = testing::lattice(2, 2, kSize, kSize);
  mesh.vertices[5].y() = 4;  // patches to the right of the tear go on down its left side
  const Color opaque(0, 0, 0, 1), nearly(0, 0, 0, 0.98f), faint(0, 0, 0, 0.1f);
  const VectorImage image = torn_picture(std::move(mesh), kMiddle, {opaque, faint, nearly, faint});
  const Raster picture = drawn(image, kScale);
  const int tear = static_cast<int>(kMiddle) * kScale;
  for (int y = 1; y + 1 < picture.height; ++y) {
    for (int x = 1; x + 1 < tear; ++x) EXPECT_LE(picture.pixel(x, y)[0], 0.04f) << x << ' ' << y;
    for (int x = tear + 1; x + 1 < picture.width; ++x) {
      EXPECT_NEAR(picture.pixel(x, y)[0], 0.9f, 0.02f) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace quadrille
