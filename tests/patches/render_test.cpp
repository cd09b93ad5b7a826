#include "quadrille/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "patch_scan.h"
#include "quadrille/error.h"
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

ErrorCode code_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::io_failure;
}

TEST(Render, ReproducesAConstantExactly) {
  PatchMesh patches = random_patches(5, 4, 23, 17, 1);
  set_linear_colors(patches, Color(0.25f, 0.5f, 0.1f, 1));
  const VectorImage image = single_layer(std::move(patches), 23, 17);
  for (const double scale : {0.3, 1.0, 2.37}) {
    const Raster r = render(image, at_scale(scale));
    ASSERT_EQ(r.channels, 3);
    for (int y = 0; y < r.height; ++y) {
      for (int x = 0; x < r.width; ++x) {
        EXPECT_NEAR(r.pixel(x, y)[0], 0.25f, 2e-7);
        EXPECT_NEAR(r.pixel(x, y)[1], 0.5f, 2e-7);
        EXPECT_NEAR(r.pixel(x, y)[2], 0.1f, 2e-7);
      }
    }
  }
}

TEST(Render, ReproducesLinearColoursAtAnyScale) {
  const double width = 23, height = 17;
  const Color base(0.1f, 0.9f, 0.2f, 1), dx(0.02f, -0.03f, 0.01f, 0), dy(0.01f, 0.005f, 0.03f, 0);
  PatchMesh patches = random_patches(5, 4, width, height, 2, {0.3, 0.9});
  set_linear_colors(patches, base, dx, dy);
  const VectorImage image = single_layer(std::move(patches), width, height);
  for (const double scale : {0.25, 0.7, 1.0, 2.37, 4.0, 16.0}) {
    const Raster r = render(image, at_scale(scale));
    double worst = 0;
    for (int y = 0; y < r.height; ++y) {
      for (int x = 0; x < r.width; ++x) {
        const float px = static_cast<float>((x + 0.5) * width / r.width);
        const float py = static_cast<float>((y + 0.5) * height / r.height);
        const Color expected = base + dx * px + dy * py;
        for (int k = 0; k < 3; ++k) {
          worst = std::max<double>(worst, std::abs(r.pixel(x, y)[k] - expected[k]));
        }
      }
    }
    // The outline's chords may leave the patch by 1/128 sample.
    EXPECT_LE(worst, 0.05 / 255 / std::min(scale, 1.0)) << "scale " << scale;
  }
}

TEST(Render, IsTheColourPolynomialToATwentiethOfAStep) {
  const VectorImage image = random_image(3);
  const PatchMesh& patches = image.layers[0].patches;
  for (const double scale : {1.0, 4.0}) {
    const Raster r = render(image, at_scale(scale));
    SampleGrid grid;
    grid.scale = {scale, scale};
    const PatchScan scan(patches, grid);
    double worst = 0;
    for (int q = 0; q < patches.patch_count(); ++q) {
      const FergusonPatch patch = ferguson_patch(patches, q);
      const PatchInverse inverse(patch.position);
      scan.scan(q, scan.bounds(q), [&](int y, int begin, int end) {
        for (int x = begin; x < end; ++x) {
          const Eigen::Vector2d uv = inverse({(x + 0.5) / scale, (y + 0.5) / scale});
          const Color expected = patch.color.at(uv.x(), uv.y()).max(0).min(1);
          for (int k = 0; k < 3; ++k) {
            worst = std::max<double>(worst, std::abs(r.pixel(x, y)[k] - expected[k]));
          }
        }
      });
    }
    EXPECT_LE(worst, 0.05 / 255) << "scale " << scale;
  }
}

TEST(Render, CountsEveryPixelOnce) {
  const VectorImage image = random_image(4);
  for (const double scale : {0.25, 0.7, 1.0, 2.37, 4.0, 16.0}) {
    const CoverageReport report = count_coverage(image, at_scale(scale));
    EXPECT_EQ(report.uncovered, 0) << scale;
    EXPECT_EQ(report.doubly_covered, 0) << scale;
  }
}

TEST(Render, CoversEveryPixelOnceOnManyMeshes) {
  Random random(77);
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    const PatchMesh patches = random_patches(random.integer(1, 6), random.integer(1, 6), 40, 30,
                                             seed, {random.uniform(0, 0.45), random.uniform(0, 2)});
    const CoverageReport report =
        count_coverage(single_layer(patches, 40, 30), at_scale(random.uniform(0.3, 5)));
    EXPECT_EQ(report.uncovered, 0) << seed;
    EXPECT_EQ(report.doubly_covered, 0) << seed;
  }
}

TEST(Render, LeavesNoHoleWhereMeshesFold) {
  Random random(78);
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    PatchMesh patches = random_patches(4, 3, 40, 30, seed % 10);
    for (auto& p : patches.mesh.vertices) {
      const bool inside = p.x() > 0 && p.x() < 40 && p.y() > 0 && p.y() < 30;
      if (inside) p = {random.uniform(1, 39), random.uniform(1, 29)};
      if (inside && seed % 7 == 0) p = {20, 15};  // all in one point
    }
    const VectorImage image = single_layer(std::move(patches), 40, 30);
    EXPECT_EQ(count_coverage(image, at_scale(random.uniform(0.5, 3))).uncovered, 0) << seed;
  }
}

TEST(Render, CountsHolesAndOverlaps) {
  // Two separate quads of one mesh: [0,4] x [0,4] and [3,6] x [0,4] in a picture of 8 x 4.
  std::vector<Eigen::Vector2d> vertices = {{0, 0}, {4, 0}, {4, 4}, {0, 4},
                                           {3, 0}, {6, 0}, {6, 4}, {3, 4}};
  PatchMesh patches = straight_patches(QuadMesh(vertices, {{0, 1, 2, 3}, {4, 5, 6, 7}}));
  for (int h = 0; h < 8; ++h) {
    patches.wedges[patches.wedge_of_corner[h]].value =
        h < 4 ? Color(1, 0, 0, 1) : Color(0, 1, 0, 1);
  }
  const VectorImage image = single_layer(std::move(patches), 8, 4);
  const CoverageReport report = count_coverage(image);
  EXPECT_EQ(report.uncovered, 2 * 4);
  EXPECT_EQ(report.doubly_covered, 1 * 4);
  // The lower patch is seen where both are.
  const Raster r = render(image);
  ASSERT_EQ(r.channels, 4);
  EXPECT_EQ(r.pixel(3, 1)[0], 1);
  EXPECT_EQ(r.pixel(3, 1)[1], 0);
  EXPECT_EQ(r.pixel(4, 1)[1], 1);
  EXPECT_EQ(r.pixel(7, 1)[3], 0);
}

TEST(Render, ARegionIsTheCropOfTheWhole) {
  VectorImage image = random_image(5, false);
  image.layers.push_back(random_image(6, false).layers[0]);
  image.layers[1].transform.rotate(0.4).scale(0.6);
  Random random(2);
  for (const double scale : {0.21, 0.7, 1.0, 7.3}) {
    const Raster whole = render(image, at_scale(scale));
    for (int trial = 0; trial < 8; ++trial) {
      RenderOptions options = at_scale(scale);
      PixelRegion region;
      region.x = random.integer(0, whole.width - 1);
      region.y = random.integer(0, whole.height - 1);
      region.width = random.integer(1, whole.width - region.x);
      region.height = random.integer(1, whole.height - region.y);
      options.region = region;
      EXPECT_TRUE(render(image, options) ==
                  crop(whole, region.x, region.y, region.width, region.height))
          << "scale " << scale << " region " << region.x << "," << region.y << "," << region.width
          << "," << region.height;
    }
  }
}

TEST(Render, ThreadsDoNotMatter) {
  const VectorImage image = random_image(7, false);
  for (const double scale : {0.4, 9.0}) {
    RunContext one, two, three;
    one.threads = 1, two.threads = 2, three.threads = 3;
    const Raster expected = render(image, at_scale(scale), one);
    EXPECT_TRUE(render(image, at_scale(scale), two) == expected);
    EXPECT_TRUE(render(image, at_scale(scale), three) == expected);
  }
}

TEST(Render, CompositesLayersAndBackground) {
  const Color red(0.5f, 0, 0, 0.5f), green(0, 0.25f, 0, 0.25f);
  const VectorImage image =
      picture_of({rectangle(0, 0, 4, 4, red), rectangle(2, 0, 4, 4, green)}, 8, 4);
  const Raster r = render(image);
  ASSERT_EQ(r.channels, 4);
  EXPECT_FLOAT_EQ(r.pixel(0, 0)[0], 1.0f);
  EXPECT_FLOAT_EQ(r.pixel(0, 0)[3], 0.5f);
  const float alpha = 0.25f + 0.75f * 0.5f;
  EXPECT_FLOAT_EQ(r.pixel(3, 1)[3], alpha);
  EXPECT_FLOAT_EQ(r.pixel(3, 1)[0], 0.5f * 0.75f / alpha);
  EXPECT_FLOAT_EQ(r.pixel(3, 1)[1], 0.25f / alpha);
  EXPECT_FLOAT_EQ(r.pixel(5, 1)[1], 1.0f);
  EXPECT_EQ(r.pixel(7, 1)[3], 0);

  RenderOptions options;
  options.background = {0, 0, 1, 1};
  const Raster on_blue = render(image, options);
  ASSERT_EQ(on_blue.channels, 3);
  EXPECT_FLOAT_EQ(on_blue.pixel(0, 0)[2], 0.5f);
  EXPECT_FLOAT_EQ(on_blue.pixel(3, 1)[0], 0.5f * 0.75f);
  EXPECT_FLOAT_EQ(on_blue.pixel(7, 1)[2], 1.0f);

  options.background = {1, 1, 1, 0.5f};
  const Raster on_half = render(image, options);
  ASSERT_EQ(on_half.channels, 4);
  EXPECT_FLOAT_EQ(on_half.pixel(7, 1)[3], 0.5f);
  EXPECT_FLOAT_EQ(on_half.pixel(7, 1)[0], 1.0f);
  EXPECT_FLOAT_EQ(on_half.pixel(0, 0)[3], 0.75f);
  EXPECT_FLOAT_EQ(on_half.pixel(0, 0)[1], 0.25f / 0.75f);
}

TEST(Render, MirroredAndSingularTransforms) {
  VectorImage image = random_image(9);
  const Raster plain = render(image);
  image.layers[0].transform = Eigen::Translation2d(37, 0) * Eigen::Scaling(-1.0, 1.0);
  const Raster mirrored = render(image);
  ASSERT_EQ(mirrored.channels, 4);
  double worst = 0;
  for (int y = 0; y < plain.height; ++y) {
    for (int x = 0; x < plain.width; ++x) {
      EXPECT_EQ(mirrored.pixel(36 - x, y)[3], 1);
      for (int k = 0; k < 3; ++k) {
        worst =
            std::max<double>(worst, std::abs(mirrored.pixel(36 - x, y)[k] - plain.pixel(x, y)[k]));
      }
    }
  }
  EXPECT_LE(worst, 1e-3);
  image.layers[0].transform.linear().setZero();
  const Raster nothing = render(image);
  EXPECT_EQ(nothing.pixel(3, 3)[3], 0);
}

TEST(Render, FoldedAndDegeneratePatchesAreDrawnWithoutTrouble) {
  Random random(10);
  for (int trial = 0; trial < 20; ++trial) {
    PatchMesh patches = straight_patches(testing::lattice(3, 3, 12, 12));
    set_random_colors(patches, trial, trial % 2);
    const double size = trial % 4 == 0 ? 0 : 14;
    for (auto& p : patches.mesh.vertices) p = {random.uniform(0, size), random.uniform(0, size)};
    for (auto& e : patches.edge_tangents) {
      for (auto& t : e) t = {random.uniform(-40, 40), random.uniform(-40, 40)};
    }
    const Raster r = render(single_layer(std::move(patches), 12, 12), at_scale(1.5));
    for (const float value : r.data) EXPECT_TRUE(value >= 0 && value <= 1);
  }
}

TEST(Render, DrawsASmallPartOfAHugeOutput) {
  const VectorImage image = random_image(11);
  RenderOptions options = at_scale(2e7);
  options.region = PixelRegion{430000000, 210000000, 40, 30};
  const Raster r = render(image, options);
  // So close up the picture is flat.
  EXPECT_NEAR(r.pixel(0, 0)[0], r.pixel(39, 29)[0], 1e-4);
}

TEST(Render, OutputSizes) {
  VectorImage image = random_image(1);
  image.width = 481, image.height = 321;
  using Size = std::array<int, 2>;
  EXPECT_EQ(output_size(image, at_scale(1)), (Size{481, 321}));
  EXPECT_EQ(output_size(image, at_scale(2.5)), (Size{1203, 803}));
  EXPECT_EQ(output_size(image, at_scale(1e-9)), (Size{1, 1}));
  RenderOptions options;
  options.width = 1000;
  EXPECT_EQ(output_size(image, options), (Size{1000, 667}));
  options.height = 10;
  EXPECT_EQ(output_size(image, options), (Size{1000, 10}));
  options.width = 0;
  EXPECT_EQ(output_size(image, options), (Size{15, 10}));
}

TEST(Render, RejectsWhatItCannotDraw) {
  const VectorImage image = random_image(1);
  for (const double scale : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    EXPECT_EQ(code_of([&] { render(image, at_scale(scale)); }), ErrorCode::invalid_argument);
  }
  EXPECT_EQ(code_of([&] { render(image, at_scale(1e12)); }), ErrorCode::limit_exceeded);
  EXPECT_EQ(code_of([&] { render(image, at_scale(1e6)); }), ErrorCode::limit_exceeded);
  RenderOptions options;
  for (const PixelRegion& region : {PixelRegion{-1, 0, 5, 5}, PixelRegion{0, 0, 38, 5},
                                    PixelRegion{0, 0, 0, 5}, PixelRegion{5, 28, 5, 2}}) {
    options.region = region;
    EXPECT_EQ(code_of([&] { render(image, options); }), ErrorCode::invalid_argument);
  }
  EXPECT_EQ(code_of([&] { render(VectorImage{}); }), ErrorCode::invalid_argument);
  VectorImage broken = image;
  broken.layers[0].patches.mesh.vertices[8].x() = NAN;
  EXPECT_EQ(code_of([&] { render(broken); }), ErrorCode::invalid_argument);
}

TEST(Render, ReportsProgressAndCanBeCancelled) {
  const VectorImage image = random_image(1);
  double last = 0;
  RunContext context;
  context.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "render");
    EXPECT_GT(fraction, last);
    last = fraction;
    return true;
  };
  render(image, at_scale(10), context);
  EXPECT_EQ(last, 1);
  context.on_progress = [](const std::string&, double) { return false; };
  EXPECT_EQ(code_of([&] { render(image, at_scale(10), context); }), ErrorCode::cancelled);
}

}  // namespace
}  // namespace quadrille
