#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "mixed_pixels.h"
#include "quadrille/fit.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/render.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Vector2d;
using namespace testing;

/// Sub-samples of a pixel along a side in the renderer's box filter.
constexpr int kRendererDivision = 16;

/// Largest difference over all channels, premultiplied.
double largest_difference(const Raster& a, const Raster& b) {
  const auto color = [](const Raster& r, int i) -> Array4d {
    const float* p = r.data.data() + static_cast<std::size_t>(i) * r.channels;
    const double alpha = r.has_alpha() ? p[3] : 1;
    return {p[0] * alpha, p[1] * alpha, p[2] * alpha, alpha};
  };
  double largest = 0;
  for (int i = 0; i < a.width * a.height; ++i) {
    largest = std::max(largest, (color(a, i) - color(b, i)).abs().maxCoeff());
  }
  return largest;
}

Raster drawn(const PatchMesh& patches, const Raster& picture) {
  return render(single_layer(patches, picture.width, picture.height));
}

/// Calls visit(wedge, center) for all corners, with the centre of the corner's quad.
template <class Visit>
void for_each_corner(const PatchMesh& patches, const Visit& visit) {
  for (int q = 0; q < patches.patch_count(); ++q) {
    Vector2d center = Vector2d::Zero();
    for (const int v : patches.mesh.quads()[q]) center += patches.mesh.vertices[v] / 4;
    for (int k = 0; k < 4; ++k) visit(patches.wedges[patches.wedge_of_corner[4 * q + k]], center);
  }
}

const Array4d kLeft(0.2, 0.9, 0.3, 1), kRight(0.8, 0.1, 0.6, 1), kNone(0, 0, 0, 0);

TEST(TornFit, FindsBothColoursOfASlantedEdgeExactly) {
  const int width = 61, height = 50;
  const double top = 22.3, bottom = 38.9;
  const auto is_left = [&](double x, double y) { return x < top + (bottom - top) * y / height; };
  for (const FitMethod method : {FitMethod::bessel, FitMethod::hermite}) {
    SplitMesh split = split_mesh(8, 6, width, height, top, bottom);
    tear(split.mesh, split.line);
    const auto painter = [&](double x, double y) { return is_left(x, y) ? kLeft : kRight; };
    const Raster picture = paint_box_filtered(width, height, 3, kRendererDivision, painter);
    FitOptions options;
    options.method = method;
    const PatchMesh patches = fit_patches(split.mesh, picture, options);
    for_each_corner(patches, [&](const Wedge& w, const Vector2d& center) {
      const Array4d expected = is_left(center.x(), center.y()) ? kLeft : kRight;
      EXPECT_LT((w.value.cast<double>() - expected).abs().maxCoeff(), 1e-4);
      EXPECT_LT(w.dx.abs().maxCoeff() + w.dy.abs().maxCoeff(), 1e-4);
    });
    EXPECT_LT(largest_difference(drawn(patches, picture), picture), 1e-4);
    // With finer coverage the renderer's rounding of it remains.
    const Raster finer = paint_box_filtered(width, height, 3, 128, painter);
    EXPECT_LT(largest_difference(drawn(fit_patches(split.mesh, finer, options), finer), finer),
              0.01);
  }
}

TEST(TornFit, FindsLinearColoursOnBothSides) {
  const int width = 60, height = 48;
  SplitMesh split = split_mesh(6, 6, width, height, 36.2, 21.7);
  tear(split.mesh, split.line);
  const Raster picture =
      paint_box_filtered(width, height, 3, kRendererDivision, [&](double x, double y) -> Array4d {
        if (x < 36.2 + (21.7 - 36.2) * y / height) return {0.01 * x, 0.9 - 0.01 * y, 0.5, 1};
        return {0.8 - 0.005 * x, 0.1, 0.015 * y, 1};
      });
  EXPECT_LT(largest_difference(drawn(fit_patches(split.mesh, picture), picture), picture), 1e-4);
}

/// A disc of kLeft in another colour, and patches with a tear along the circle fitted to it.
struct TornDisc {
  Raster picture;
  PatchMesh patches;

  TornDisc(int columns, int width, int height, const Vector2d& center, double radius,
           const Array4d& outside) {
    const auto color_at = [&](const Vector2d& p) {
      return (p - center).norm() < radius ? kLeft : outside;
    };
    DiscMesh disc = disc_mesh(columns, 1, 2, width, height, center, radius);
    tear(disc.mesh, disc.circle);
    picture =
        paint_box_filtered(width, height, outside[3] < 1 ? 4 : 3, 32, [&](double x, double y) {
          return color_at({x, y});
        });
    patches = fit_patches(disc.mesh, picture);
    // What remains is the distance of the curves from the circle.
    for_each_corner(patches, [&](const Wedge& w, const Vector2d& middle) {
      EXPECT_LT((w.value.cast<double>() - color_at(middle)).abs().maxCoeff(), 0.02);
    });
  }
};

TEST(TornFit, FindsBothColoursOfADisc) {
  const TornDisc disc(4, 64, 60, {31.3, 30.6}, 18.7, kRight);
  EXPECT_LT(largest_difference(drawn(disc.patches, disc.picture), disc.picture), 0.02);
}

TEST(TornFit, KeepsTheColourInsideASilhouette) {
  const TornDisc disc(5, 64, 64, {32.4, 31.1}, 20.2, kNone);
  // No halo: wherever something is drawn it has the colour of the inside.
  const Raster result = drawn(disc.patches, disc.picture);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const float* p = result.pixel(x, y);
      if (p[3] < 0.1) continue;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(p[k], kLeft[k], 0.02) << x << ' ' << y;
    }
  }
}

/// The quads inside the circle alone, as a mesh region.
QuadMesh inside_of(const QuadMesh& disc, int columns, int rings_inside) {
  const int around = 4 * columns;
  const int vertices = (columns + 1) * (columns + 1) + rings_inside * around;
  const int quads = columns * columns + rings_inside * around;
  return {{disc.vertices.begin(), disc.vertices.begin() + vertices},
          {disc.quads().begin(), disc.quads().begin() + quads}};
}

TEST(TornFit, ContinuesThePictureAtTheBorderOfARegion) {
  const DiscMesh disc = disc_mesh(4, 2, 1, 64, 60, {30.7, 31.2}, 21.4);
  const QuadMesh region = inside_of(disc.mesh, 4, 2);
  const Raster picture = paint_box_filtered(64, 60, 3, 1, [](double x, double y) -> Array4d {
    return {0.01 * x, 0.9 - 0.01 * y, 0.3 + 0.005 * (x + y), 1};
  });
  for (const FitMethod method : {FitMethod::bessel, FitMethod::bessel_ls, FitMethod::hermite}) {
    FitOptions options;
    options.method = method;
    const PatchMesh patches = fit_patches(region, picture, options);
    for (int h = 0; h < region.halfedge_count(); ++h) {
      const Vector2d p = region.vertices[region.origin(h)];
      const Wedge& w = patches.wedges[patches.wedge_of_corner[h]];
      EXPECT_NEAR(w.value[0], 0.01 * p.x(), 1e-5);
      EXPECT_NEAR(w.value[1], 0.9 - 0.01 * p.y(), 1e-5);
    }
  }
}

TEST(TornFit, FollowsAJumpThatEndsInThePicture) {
  const int width = 64, height = 64;
  const double top = 25.3, bottom = 38.9, end = 40;
  SplitMesh split = split_mesh(8, 8, width, height, top, bottom);
  tear(split.mesh, std::span(split.line).first(5));  // down to y = 40
  const Raster picture =
      paint_box_filtered(width, height, 3, kRendererDivision, [&](double x, double y) -> Array4d {
        const double fading = std::pow(std::max(0.0, 1 - y / end), 2);
        const double side = x < top + (bottom - top) * y / height ? -0.3 : 0.3;
        return {0.5 + side * fading, 0.5 - side * fading, 0.4, 1};
      });
  EXPECT_LT(largest_difference(drawn(fit_patches(split.mesh, picture), picture), picture), 0.005);
}

TEST(TornFit, FindsThreeColoursAroundAJunction) {
  const int width = 63, height = 61, n = 6;
  // A line from the top to the bottom, and one from its middle to the right.
  SplitMesh split = split_mesh(n, n, width, height, 29.7, 33.2);
  std::vector<int> torn = split.line;
  for (int i = n / 2; i < n; ++i) {
    const int a = (n / 2) * (n + 1) + i;
    torn.push_back(edge_between(split.mesh, a, a + 1));
  }
  tear(split.mesh, torn);
  const auto side = [&](double x, double y) -> Array4d {
    if (x < 29.7 + (33.2 - 29.7) * y / height) return kLeft;
    return y < height / 2.0 ? kRight : Array4d(0.4, 0.4, 0.9, 1);
  };
  const Raster picture = paint_box_filtered(width, height, 3, kRendererDivision, side);
  const PatchMesh patches = fit_patches(split.mesh, picture);
  EXPECT_EQ(patches.wedges.size(), split.mesh.vertices.size() + n + 1 + n / 2 + 1);
  EXPECT_LT(largest_difference(drawn(patches, picture), picture), 1e-4);
  for_each_corner(patches, [&](const Wedge& w, const Vector2d& center) {
    EXPECT_LT((w.value.cast<double>() - side(center.x(), center.y())).abs().maxCoeff(), 1e-4);
  });
}

/// Patches with many tears, and with colours that need no clamping.
PatchMesh torn_patches(std::uint32_t seed, bool opaque) {
  PatchMesh patches = random_patches(12, 9, 150, 100, seed);
  Random random(seed);
  for (std::uint8_t& flags : patches.mesh.edge_flags) {
    if (random.uniform() < 0.4) flags |= kTearEdge;
  }
  const auto tangents = patches.edge_tangents;
  patches = straight_patches(patches.mesh);
  patches.edge_tangents = tangents;
  patches.opaque = opaque;
  for (Wedge& w : patches.wedges) {
    const float alpha = opaque ? 1.0f : static_cast<float>(random.uniform(0.6, 0.9));
    for (int k = 0; k < 3; ++k) w.value[k] = static_cast<float>(random.uniform(0.2, 0.5));
    w.value[3] = alpha;
  }
  return patches;
}

TEST(MixedPixels, AgreeWithTheRenderer) {
  for (const bool opaque : {true, false}) {
    const PatchMesh patches = torn_patches(3, opaque);
    const Raster picture = render(single_layer(patches, 150, 100));
    WedgeRows rows;
    const MixedPixels mixed(PatchScan(patches, SampleGrid{}), picture, rows);
    rows.finish(patches.wedges.size());
    ASSERT_FALSE(mixed.pixels().empty());
    rows.evaluate_residual();
    for (int w = 0; w < static_cast<int>(patches.wedges.size()); ++w) {
      WedgeUnknowns sum = WedgeUnknowns::Zero();
      rows.gather(w, sum);
      EXPECT_LT(sum.col(0).cwiseAbs().maxCoeff(), 1e-3 * std::max(1.0, rows.block(w)(0, 0)));
    }
  }
}

TEST(MixedPixels, AreNoneWithoutTearsInAPictureThatIsFilled) {
  const PatchMesh patches = random_patches(5, 4, 50, 40, 2);
  WedgeRows rows;
  const MixedPixels mixed(PatchScan(patches, SampleGrid{}), Raster(50, 40, 3), rows);
  EXPECT_EQ(rows.size(), 0);
  EXPECT_TRUE(mixed.pixels().empty());
  EXPECT_FALSE(mixed.contains(20 * 50 + 20));
}

TEST(TornFit, SliversBetweenTearsStaySane) {
  Random random(5);
  Raster picture(96, 96, 3);
  for (float& c : picture.data) c = static_cast<float>(random.uniform(0.3, 0.7));
  for (const int columns : {16, 32, 48}) {
    QuadMesh mesh = random_patches(columns, columns, 96, 96, 3).mesh;
    for (std::uint8_t& flags : mesh.edge_flags) {
      if (random.uniform() < 0.4) flags |= kTearEdge;
    }
    for (const FitMethod method : {FitMethod::bessel, FitMethod::bessel_ls, FitMethod::hermite}) {
      FitOptions options;
      options.method = method;
      for (const Wedge& w : fit_patches(mesh, picture, options).wedges) {
        ASSERT_LT((w.value - 0.5f).abs().maxCoeff(), 10) << columns;
      }
    }
  }
}

TEST(TornFit, IsTheSameForAnyNumberOfThreads) {
  const PatchMesh start = torn_patches(7, false);
  const Raster picture = render(single_layer(torn_patches(8, false), 150, 100));
  const auto fit = [&](int threads) {
    RunContext context;
    context.threads = threads;
    PatchMesh patches = start;
    fit_colors(patches, picture, {}, context);
    return patches;
  };
  const PatchMesh one = fit(1), two = fit(2);
  EXPECT_EQ(0,
            std::memcmp(one.wedges.data(), two.wedges.data(), one.wedges.size() * sizeof(Wedge)));
}

}  // namespace
}  // namespace quadrille
