#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fit_smoothness.h"
#include "quadrille/error.h"
#include "quadrille/fit.h"
#include "quadrille/patch_geometry.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::lattice;

/// Value, derivatives by x and y, and mixed derivative of a grey level.
using Jet = std::function<std::array<double, 4>(const Vector2d&)>;

void set_wedges(PatchMesh& patches, const Jet& jet) {
  for (int c = 0; c < 4 * patches.patch_count(); ++c) {
    Wedge& wedge = patches.wedges[patches.wedge_of_corner[c]];
    const auto [value, dx, dy, mixed] = jet(patches.mesh.vertices[patches.mesh.origin(c)]);
    const auto grey = [](double v) { return Color(Eigen::Array4d(v, v, v, 0).cast<float>()); };
    wedge = {grey(value), grey(dx), grey(dy), grey(mixed)};
  }
}

/// The sum of squares over all rows, of one channel.
double bending(const PatchMesh& patches, double length) {
  WedgeRows rows;
  add_smoothness(patches, length, rows);
  const WedgeRows::Vector none(patches.wedges.size(), WedgeUnknowns::Zero());
  double sum = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    sum += std::pow(static_cast<double>(rows.rest(r, none)[0]), 2);
  }
  return sum;
}

PatchMesh patches_on(QuadMesh mesh) {
  PatchMesh patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  return patches;
}

TEST(SmoothFit, RowsAddUpToTheBendingOfCubics) {
  const double length = 0.7, width = 8, height = 6;
  PatchMesh patches = patches_on(lattice(5, 4, width, height));
  // 0.3 x^2 - 0.2 x y + 0.1 y^2 + 0.02 x^3
  set_wedges(patches, [](const Vector2d& p) -> std::array<double, 4> {
    const double x = p.x(), y = p.y();
    return {0.3 * x * x - 0.2 * x * y + 0.1 * y * y + 0.02 * x * x * x,
            0.6 * x - 0.2 * y + 0.06 * x * x, -0.2 * x + 0.2 * y, -0.2};
  });
  // The integral of (0.6 + 0.12 x)^2 + 2 * 0.2^2 + 0.2^2 over the rectangle.
  const double along_x = (std::pow(0.6 + 0.12 * width, 3) - std::pow(0.6, 3)) / (3 * 0.12) * height;
  const double expected = along_x + (2 * 0.04 + 0.04) * width * height;
  EXPECT_NEAR(bending(patches, length), std::pow(length, 4) * expected, 1e-4 * expected);
}

TEST(SmoothFit, LinearColoursBendNowhere) {
  PatchMesh patches = testing::random_patches(14, 10, 20, 15, 3);
  set_wedges(patches, [](const Vector2d& p) -> std::array<double, 4> {
    return {0.2 + 0.03 * p.x() - 0.02 * p.y(), 0.03, -0.02, 0};
  });
  EXPECT_LT(bending(patches, 0.5), 1e-10);
}

/// How far the patches bend that are dark on the left of x = 6 and light on its right.
double bending_of_two_shades(const QuadMesh& mesh) {
  PatchMesh patches = patches_on(mesh);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const bool is_left = mesh.vertices[mesh.quads()[q][0]].x() < 6;
    for (int k = 0; k < 4; ++k) {
      Wedge& wedge = patches.wedges[patches.wedge_of_corner[4 * q + k]];
      wedge = {};
      wedge.value.setConstant(is_left ? 0.1f : 0.9f);
    }
  }
  return bending(patches, 0.5);
}

TEST(SmoothFit, JumpsAcrossTearsBendNothing) {
  QuadMesh mesh = lattice(6, 4, 12, 8);
  EXPECT_GT(bending_of_two_shades(mesh), 0.1);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool is_middle =
        mesh.vertices[mesh.origin(h)].x() == 6 && mesh.vertices[mesh.tip(h)].x() == 6;
    if (is_middle) mesh.edge_flags[e] = kTearEdge;
  }
  EXPECT_EQ(bending_of_two_shades(mesh), 0);
}

TEST(SmoothFit, QuadsWithoutAnAreaAreRefusedRatherThanLeftUnfitted) {
  const QuadMesh mesh = lattice(6, 5, 12, 10);
  std::vector<Vector2d> vertices = mesh.vertices;
  for (Vector2d& v : vertices) {
    if (v == Vector2d(4, 4) || v == Vector2d(4, 6)) v = {6, 4};
  }
  PatchMesh patches = straight_patches(QuadMesh(vertices, mesh.quads()));
  try {
    fit_colors(patches, Raster(12, 10, 3));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::numerical_failure);
  }
}

/// More unknowns than pixels: only the smoothness says what happens between them.
TEST(SmoothFit, ColoursDoNotRingBetweenPixels) {
  const int width = 24, height = 18;
  const auto shade = [](double x, double y) {
    return 0.5 + 0.3 * std::sin(0.7 * x + 0.3) * std::cos(0.5 * y);
  };
  Raster picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.pixel(x, y)[c] = static_cast<float>(shade(x + 0.5, y + 0.5));
      }
    }
  }
  // At the corners of pixels, away from the border.
  const auto largest_error = [&](double smoothness) {
    FitOptions options;
    options.smoothness = smoothness;
    const PatchMesh patches = fit_patches(lattice(20, 15, width, height), picture, options);
    double largest = 0;
    for (int q = 0; q < patches.patch_count(); ++q) {
      const FergusonPatch patch = ferguson_patch(patches, q);
      for (const double u : {0.1, 0.4, 0.7}) {
        const Vector2d p = patch.position.at(u, 1 - u);
        if (p.x() < 2 || p.y() < 2 || p.x() > width - 2 || p.y() > height - 2) continue;
        const double error = patch.color.at(u, 1 - u)[0] - shade(p.x(), p.y());
        largest = std::max(largest, std::abs(error));
      }
    }
    return largest;
  };
  EXPECT_LT(largest_error(0.2), 0.01);
  EXPECT_GT(largest_error(0), 3 * largest_error(0.2));
}

}  // namespace
}  // namespace quadrille
