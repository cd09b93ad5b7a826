// Pixels that the renderer averages: on outlines, along tears, and below scale 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "quadrille/render.h"
#include "render_scenes.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using testing::at_scale;
using testing::picture_of;
using testing::Random;
using testing::random_image;
using testing::random_patches;
using testing::rectangle;
using testing::set_linear_colors;
using testing::set_random_colors;
using testing::single_layer;

/// Mean over the 16 x 16 pixels of a 16 times finer picture, premultiplied.
Color mean_of_fine(const Raster& fine, int x, int y) {
  Color sum = Color::Zero();
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16; ++i) {
      const float* p = fine.pixel(16 * x + i, 16 * y + j);
      sum += Color(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
    }
  }
  return sum / 256;
}

TEST(Render, AveragesPixelsOnTheOutlineOfARotatedLayer) {
  VectorImage image = random_image(8);
  image.layers[0].transform = Eigen::Translation2d(14, 2) * Eigen::Rotation2Dd(0.37);
  image.width = 48, image.height = 48;
  const Raster r = render(image), fine = render(image, at_scale(16));
  double sum = 0, worst = 0, count = 0;
  for (int y = 0; y < r.height; ++y) {
    for (int x = 0; x < r.width; ++x) {
      const Color truth = mean_of_fine(fine, x, y);
      const float* p = r.pixel(x, y);
      if (truth[3] < 1e-4 || truth[3] > 1 - 1e-4) {
        EXPECT_NEAR(p[3], truth[3], 1e-4);
        continue;
      }
      const Color drawn(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
      for (int k = 0; k < 4; ++k) {
        const double error = 255 * std::abs(drawn[k] - truth[k]);
        sum += error;
        worst = std::max(worst, error);
        ++count;
      }
    }
  }
  ASSERT_GT(count, 300);
  EXPECT_LE(sum / count, 1.0);
  EXPECT_LE(worst, 8.0);
}

TEST(Render, AveragesOutlinesOfAllSlopesAndShifts) {
  Random random(31);
  double sum = 0;
  long count = 0;
  for (int turn = 0; turn < 24; ++turn) {
    VectorImage image = random_image(8);
    image.layers[0].transform = Eigen::Translation2d(36 + random.uniform(), 36 + random.uniform()) *
                                Eigen::Rotation2Dd(turn * EIGEN_PI / 12 + 0.01) *
                                Eigen::Translation2d(-18, -14);
    image.width = image.height = 72;
    const Raster r = render(image), fine = render(image, at_scale(16));
    for (int y = 0; y < r.height; ++y) {
      for (int x = 0; x < r.width; ++x) {
        const Color truth = mean_of_fine(fine, x, y);
        if (truth[3] < 1e-4 || truth[3] > 1 - 1e-4) continue;
        const float* const p = r.pixel(x, y);
        const Color drawn(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
        sum += 255 * (drawn - truth).abs().mean();
        ++count;
      }
    }
  }
  ASSERT_GT(count, 3000);
  EXPECT_LE(sum / static_cast<double>(count), 1.0);
}

/// A rectangle of 36 x 28 in 4 x 2 patches, torn down the middle, with random colours.
PatchMesh torn_rectangle(std::uint32_t seed) {
  QuadMesh mesh = testing::lattice(4, 2, 36, 28);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool middle =
        mesh.vertices[mesh.origin(h)].x() == 18 && mesh.vertices[mesh.tip(h)].x() == 18;
    if (middle) mesh.edge_flags[e] |= kTearEdge;
  }
  PatchMesh patches = straight_patches(std::move(mesh));
  set_random_colors(patches, seed);
  return patches;
}

/// Premultiplied mean of the colours at 16 x 16 points of a pixel, evaluated in the patches
/// themselves, and on how many points lie left of the tear, right of it, and outside.
struct PixelTruth {
  Color mean = Color::Zero();
  int left = 0, right = 0, outside = 0;
  bool is_smooth() const { return std::max({left, right, outside}) == 256; }
};
PixelTruth truth_of_torn(const std::vector<FergusonPatch>& patches, const Eigen::Affine2d& to_mesh,
                         int x, int y) {
  PixelTruth truth;
  for (int i = 0; i < 256; ++i) {
    const Eigen::Vector2d p =
        to_mesh * Eigen::Vector2d(x + (i % 16 + 0.5) / 16, y + (i / 16 + 0.5) / 16);
    if (p.x() < 0 || p.x() >= 36 || p.y() < 0 || p.y() >= 28) {
      ++truth.outside;
      continue;
    }
    ++(p.x() < 18 ? truth.left : truth.right);
    const int column = static_cast<int>(p.x() / 9), row = static_cast<int>(p.y() / 14);
    const Color c = patches[4 * row + column].color.at(p.x() / 9 - column, p.y() / 14 - row);
    truth.mean += Color(c.max(0).min(1)) / 256;
  }
  return truth;
}

TEST(Render, AveragesTearsAndOutlinesOfAllSlopesAndShifts) {
  Random random(41);
  double tear_sum = 0, outline_sum = 0;
  long tears = 0, outlines = 0;
  for (int turn = 0; turn < 48; ++turn) {
    PatchMesh torn = torn_rectangle(turn);
    std::vector<FergusonPatch> patches;
    for (int q = 0; q < torn.patch_count(); ++q) patches.push_back(ferguson_patch(torn, q));
    VectorImage image = testing::single_layer(std::move(torn), 72, 72);
    image.layers[0].transform = Eigen::Translation2d(36 + random.uniform(), 36 + random.uniform()) *
                                Eigen::Rotation2Dd(turn * EIGEN_PI / 24 + 0.01) *
                                Eigen::Translation2d(-18, -14);
    const Eigen::Affine2d to_mesh = image.layers[0].transform.inverse();
    const Raster r = render(image);
    for (int y = 0; y < r.height; ++y) {
      for (int x = 0; x < r.width; ++x) {
        const PixelTruth truth = truth_of_torn(patches, to_mesh, x, y);
        if (truth.is_smooth()) continue;
        const float* const p = r.pixel(x, y);
        const Color drawn(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
        const double error = 255 * (drawn - truth.mean).abs().mean();
        (truth.outside ? outline_sum : tear_sum) += error;
        ++(truth.outside ? outlines : tears);
      }
    }
  }
  ASSERT_GT(tears, 1500);
  ASSERT_GT(outlines, 5000);
  EXPECT_LE(tear_sum / static_cast<double>(tears), 1.0);
  EXPECT_LE(outline_sum / static_cast<double>(outlines), 1.0);
}

TEST(Render, DoesNotTouchAnOutlineBetweenPixels) {
  const VectorImage image = picture_of({rectangle(3, 2, 6, 5, Color(0, 1, 0, 1))}, 12, 10);
  for (const double scale : {1.0, 3.0}) {
    const Raster r = render(image, at_scale(scale));
    for (int y = 0; y < r.height; ++y) {
      for (int x = 0; x < r.width; ++x) {
        const bool inside = x >= 3 * scale && x < 9 * scale && y >= 2 * scale && y < 7 * scale;
        EXPECT_EQ(r.pixel(x, y)[3], inside ? 1 : 0);
      }
    }
  }
}

TEST(Render, TakesTheAreaOfAPartlyCoveredPixel) {
  const VectorImage image =
      picture_of({rectangle(2.25, 3.5, 4, 4, Color(0.5f, 0.25f, 0, 1))}, 10, 10);
  const Raster r = render(image);
  EXPECT_FLOAT_EQ(r.pixel(2, 5)[3], 0.75f);
  EXPECT_FLOAT_EQ(r.pixel(6, 5)[3], 0.25f);
  EXPECT_FLOAT_EQ(r.pixel(4, 3)[3], 0.5f);
  EXPECT_FLOAT_EQ(r.pixel(2, 3)[3], 0.375f);
  EXPECT_FLOAT_EQ(r.pixel(2, 3)[0], 0.5f);
  EXPECT_FLOAT_EQ(r.pixel(2, 3)[1], 0.25f);
}

TEST(Render, MixesBothSidesOfATear) {
  // Two columns, torn along x = 5.25: black on the left, white on the right.
  QuadMesh mesh = testing::lattice(2, 2, 10, 8);
  for (auto& v : mesh.vertices) {
    if (v.x() == 5) v.x() = 5.25;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    if (mesh.vertices[mesh.origin(h)].x() == 5.25 && mesh.vertices[mesh.tip(h)].x() == 5.25) {
      mesh.edge_flags[e] |= kTearEdge;
    }
  }
  PatchMesh patches = straight_patches(std::move(mesh));
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const float value = QuadMesh::quad_of(h) % 2 ? 1.0f : 0.0f;
    patches.wedges[patches.wedge_of_corner[h]].value = Color(value, value, value, 1);
  }
  const Raster r = render(single_layer(std::move(patches), 10, 8));
  ASSERT_EQ(r.channels, 3);
  for (int y = 0; y < 8; ++y) {
    EXPECT_EQ(r.pixel(4, y)[0], 0);
    EXPECT_FLOAT_EQ(r.pixel(5, y)[0], 0.75f);
    EXPECT_EQ(r.pixel(6, y)[0], 1);
  }
}

TEST(Render, BoxFiltersBelowScaleOne) {
  PatchMesh patches = random_patches(6, 5, 40, 32, 12);
  set_random_colors(patches, 13);
  const VectorImage image = single_layer(std::move(patches), 40, 32);
  const Raster whole = render(image);
  for (const int k : {2, 4, 8}) {
    const Raster small = render(image, at_scale(1.0 / k));
    ASSERT_EQ(small.width, 40 / k);
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) {
        double sum = 0;
        for (int j = 0; j < k * k; ++j) sum += whole.pixel(k * x + j % k, k * y + j / k)[1];
        EXPECT_NEAR(small.pixel(x, y)[1], sum / (k * k), 1e-6);
      }
    }
  }
  // More samples per pixel than a block holds.
  PatchMesh large = straight_patches(testing::lattice(4, 3, 1200, 700));
  set_linear_colors(large, Color(0, 1, 0, 1), Color(1 / 1200.0f, 0, 0, 0));
  RenderOptions tiny;
  tiny.width = 2;
  tiny.height = 1;
  const Raster r = render(single_layer(std::move(large), 1200, 700), tiny);
  EXPECT_NEAR(r.pixel(0, 0)[0], 0.25, 1e-4);
  EXPECT_NEAR(r.pixel(1, 0)[0], 0.75, 1e-4);
}

}  // namespace
}  // namespace quadrille
