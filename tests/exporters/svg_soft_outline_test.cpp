#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "librsvg.h"
#include "quadrille/export.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

constexpr double kSide = 72;

/// A ring of patches around the middle of the picture whose alpha falls from 1 to 0 within about a
/// pixel, over patches much thinner than one, at uneven radii.
VectorImage soft_ring(std::uint32_t seed) {
  constexpr int kSectors = 40;
  constexpr double kRadii[] = {13, 15, 26, 26.4, 26.7, 27.1, 27.4, 33};
  constexpr double kAlphas[] = {1, 1, 1, 1, 0.9, 0.3, 0, 0};
  constexpr int kRings = std::size(kRadii);
  testing::Random random(seed);
  std::vector<Eigen::Vector2d> vertices;
  for (int i = 0; i < kSectors; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / kSectors;
    const double uneven = random.uniform(-0.3, 0.3);
    for (const double radius : kRadii) {
      vertices.emplace_back(Eigen::Vector2d::Constant(kSide / 2) +
                            (radius + uneven) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  std::vector<QuadMesh::Quad> quads;
  for (int i = 0; i < kSectors; ++i) {
    const int a = kRings * i, b = kRings * ((i + 1) % kSectors);
    for (int k = 0; k + 1 < kRings; ++k) quads.push_back({a + k, a + k + 1, b + k + 1, b + k});
  }
  PatchMesh patches = straight_patches(QuadMesh(std::move(vertices), std::move(quads)));
  patches.opaque = false;
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const int vertex = patches.mesh.origin(h);
    const float alpha = static_cast<float>(kAlphas[vertex % kRings]);
    const float shade = 0.2f + 0.6f * static_cast<float>(vertex / kRings) / kSectors;
    patches.wedges[patches.wedge_of_corner[h]].value =
        Color(alpha * shade, 0.3f * alpha, 0.8f * alpha, alpha);
  }
  return testing::single_layer(std::move(patches), kSide, kSide);
}

float alpha_at(const Raster& raster, int x, int y) {
  return raster.has_alpha() ? raster.pixel(x, y)[3] : 1;
}

/// True when the picture is opaque as far as two pixels around.
bool is_inside(const Raster& picture, int x, int y) {
  for (int j = std::max(0, y - 2); j <= std::min(picture.height - 1, y + 2); ++j) {
    for (int i = std::max(0, x - 2); i <= std::min(picture.width - 1, x + 2); ++i) {
      if (alpha_at(picture, i, j) < 1) return false;
    }
  }
  return true;
}

struct AlphaErrors {
  double leak = 0;    ///< the most that is missing inside, in 8-bit steps
  double square = 0;  ///< mean over the picture
  double soft = 0;    ///< share of the picture that is neither opaque nor transparent
};

AlphaErrors alpha_errors(const Raster& drawn, const Raster& expected) {
  AlphaErrors errors;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      const double error = 255 * (alpha_at(expected, x, y) - alpha_at(drawn, x, y));
      if (is_inside(expected, x, y)) errors.leak = std::max(errors.leak, error);
      errors.square += error * error / (drawn.width * drawn.height);
      const float alpha = alpha_at(expected, x, y);
      if (alpha > 0 && alpha < 1) errors.soft += 1.0 / (drawn.width * drawn.height);
    }
  }
  return errors;
}

TEST(SvgSoftOutline, ThinPatchesLeaveNoHolesAndNoSpecks) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const VectorImage image = soft_ring(seed);
    const auto svg = test::scratch_dir() / "soft.svg";
    write_svg(image, svg);
    for (const int scale : {1, 4}) {
      const int side = static_cast<int>(kSide) * scale;
      RenderOptions options;
      options.scale = scale;
      const AlphaErrors errors =
          alpha_errors(test::drawn_by_librsvg(svg, {side, side}), render(image, options));
      EXPECT_LE(errors.leak, 8) << scale;
      // Programs take gradients at the middles of pixels. Where alpha falls by 1 across a pixel and
      // is constant beyond, that is an eighth from the mean over the pixel at most.
      const double sampling = scale == 1 ? 255.0 / 8 * std::sqrt(errors.soft) : 0;
      EXPECT_LT(std::sqrt(errors.square), 3 + sampling) << scale;
    }
  }
}

}  // namespace
}  // namespace quadrille
