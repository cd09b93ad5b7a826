#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pdf_records.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using test::Painted;
using test::ReadPatch;

/// Of the grid that points are rounded to, and how far patches overlap: one of them; in pixels.
constexpr double kUnit = 1.0 / 16, kOverlap = kUnit;

Eigen::AlignedBox2d box_of(const ReadPatch& patch) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& p : patch.points) box.extend(p);
  return box;
}

/// How far `x` lies from the nearest line of a lattice.
double from_line(double x, double spacing) {
  return std::abs(x - spacing * std::round(x / spacing));
}

TEST(PdfRidges, PatchesReachOverTheirNeighboursByAnOverlapAndOverThePageByMore) {
  constexpr double kSize = 48, kSpacing = 12;
  PatchMesh patches = straight_patches(testing::lattice(4, 4, kSize, kSize));
  testing::set_linear_colors(patches, Color(0.5f, 0.25f, 0.75f, 1));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  int ridges = 0;
  for (const ReadPatch& patch : Painted(image.layers[0], 2).read()) {
    const Eigen::AlignedBox2d box = box_of(patch);
    if (box.sizes().minCoeff() == 0) continue;  // fills a row of the predictor
    for (const double x : {box.min().x(), box.min().y(), box.max().x(), box.max().y()}) {
      if (x <= 0 || x >= kSize) {
        EXPECT_EQ(from_line(x, kSpacing), 0.5) << x;
      } else {
        EXPECT_LE(from_line(x, kSpacing), kOverlap) << x;
        ridges += from_line(x, kSpacing) > 0;
      }
    }
    // Outward on every side.
    EXPECT_GE(box.sizes().minCoeff(), kSpacing);
  }
  EXPECT_GT(ridges, 0);
}

TEST(PdfRidges, ColorsGoOnInThemAsTheyCome) {
  // 21 steps per pixel.
  constexpr double kSize = 12;
  PatchMesh patches = straight_patches(testing::lattice(4, 4, kSize, kSize));
  testing::set_linear_colors(patches, Color(0.1f, 0.9f, 0.1f, 1), Color(0.8f / kSize, 0, 0, 0),
                             Color(0, -0.8f / kSize, 0, 0));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  for (const ReadPatch& patch : Painted(image.layers[0], 2).read()) {
    for (int corner = 0; corner < 4; ++corner) {
      const Vector2d& p = patch.points[3 * corner];
      EXPECT_NEAR(patch.colors[corner][0], 255 * (0.1 + 0.8 * p.x() / kSize), 1.5) << p.transpose();
      EXPECT_NEAR(patch.colors[corner][1], 255 * (0.9 - 0.8 * p.y() / kSize), 1.5) << p.transpose();
    }
  }
}

TEST(PdfRidges, WhatReachesBelowAThinPatchEndsThere) {
  constexpr double kSize = 20, kTear = 10, kEnd = 10.5;
  QuadMesh mesh = testing::lattice(2, 3, kSize, kSize);
  for (Vector2d& p : mesh.vertices) {
    if (p.y() > 1 && p.y() < 19) p.y() = p.y() < kSize / 2 ? kTear : kEnd;
  }
  PatchMesh patches = straight_patches(std::move(mesh));
  testing::set_linear_colors(patches, Color(0.5f, 0.25f, 0.75f, 1));
  for (int e = 0; e < patches.mesh.edge_count(); ++e) {
    const int h = patches.mesh.halfedge(e);
    const Vector2d a = patches.mesh.vertices[patches.mesh.origin(h)],
                   b = patches.mesh.vertices[patches.mesh.tip(h)];
    if (a.y() == kTear && b.y() == kTear) patches.mesh.edge_flags[e] |= kTearEdge;
    // Fast at its ends, and yet no longer.
    if (std::abs(b.y() - a.y()) == kEnd - kTear) {
      for (Vector2d& tangent : patches.edge_tangents[e]) tangent *= 2.5;
    }
  }
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  int reaching = 0;
  for (const ReadPatch& patch : Painted(image.layers[0], 2).read()) {
    const Eigen::AlignedBox2d box = box_of(patch);
    if (box.min().y() > kTear / 2) continue;
    EXPECT_LE(box.max().y(), kEnd);
    reaching += box.max().y() > kTear;
  }
  EXPECT_EQ(reaching, 2);
}

/// Straight pieces of the curves around a patch.
std::vector<Vector2d> outline(const ReadPatch& patch) {
  constexpr int kPieces = 16;
  std::vector<Vector2d> points;
  for (int side = 0; side < 12; side += 3) {
    for (int k = 0; k < kPieces; ++k) {
      const double t = double(k) / kPieces, r = 1 - t;
      const auto& p = patch.points;
      points.push_back(r * r * r * p[side] + 3 * r * r * t * p[side + 1] +
                       3 * r * t * t * p[side + 2] + t * t * t * p[(side + 3) % 12]);
    }
  }
  return points;
}

bool contains(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    inside ^= p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return inside;
}

TEST(PdfRidges, LeaveNoPointOpenBetweenPatchesThatAreDividedDifferently) {
  constexpr double kSize = 48;
  for (const std::uint32_t seed : {1, 2, 3}) {
    PatchMesh patches = testing::random_patches(4, 4, kSize, kSize, seed);
    testing::set_random_colors(patches, seed + 10);
    const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
    const std::vector<ReadPatch> read = Painted(image.layers[0], 2).read();
    testing::Random random(seed);
    for (int i = 0; i < 4000; ++i) {
      const Vector2d p(random.uniform(0, kSize), random.uniform(0, kSize));
      const auto covers = [&](const ReadPatch& patch) {
        return box_of(patch).contains(p) && contains(outline(patch), p);
      };
      ASSERT_TRUE(std::ranges::any_of(read, covers)) << seed << ": " << p.transpose();
    }
  }
}

}  // namespace
}  // namespace quadrille
