#include "quadrille/renderer.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstdlib>
#include <new>

#include "patch_scan.h"
#include "quadrille/error.h"
#include "render_scenes.h"

namespace {

std::size_t allocations = 0;

}  // namespace

// Counts this program's allocations.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
// GCC takes them for mismatched where it inlines delete but not new.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace quadrille {
namespace {

using testing::overshooting_image;
using testing::Random;
using testing::random_image;
using testing::random_patches;
using testing::set_linear_colors;
using testing::set_random_colors;
using testing::single_layer;

RunContext with_threads(int threads) {
  RunContext context;
  context.threads = threads;
  return context;
}

struct Bytes {
  std::vector<std::uint8_t> data;
  std::ptrdiff_t row;
};

Bytes draw(Renderer& renderer, const VectorImage& image, RenderOptions options,
           const PixelLayout& layout = {}, int threads = 1) {
  const auto [width, height] = output_size(image, options);
  const PixelRegion region = options.region.value_or(PixelRegion{0, 0, width, height});
  const int bytes[] = {1, 2, 4};
  Bytes out;
  out.row =
      std::ptrdiff_t{1} * region.width * layout.channels * bytes[static_cast<int>(layout.type)];
  out.data.resize(static_cast<std::size_t>(out.row) * region.height);
  renderer.draw(options, layout, {out.data.data(), out.row}, with_threads(threads));
  return out;
}

/// Parameters of a point by Newton's method in doubles, from the nearest of a grid of starts.
Eigen::Vector2d parameters_of(const BicubicHermite<Eigen::Vector2d>& p,
                              const Eigen::Vector2d& point) {
  Eigen::Vector2d best(0.5, 0.5);
  double nearest = INFINITY;
  for (int i = 0; i < 81; ++i) {
    const Eigen::Vector2d at((i % 9) / 8.0, (i / 9) / 8.0);
    const double distance = (p.at(at.x(), at.y()) - point).norm();
    if (distance < nearest) nearest = distance, best = at;
  }
  for (int step = 0; step < 30; ++step) {
    Eigen::Matrix2d jacobian;
    jacobian << p.derivative_u(best.x(), best.y()), p.derivative_v(best.x(), best.y());
    best += jacobian.inverse() * (point - p.at(best.x(), best.y()));
  }
  return best;
}

Eigen::Array4d color_at(const BicubicHermite<Color>& color, double u, double v) {
  BicubicHermite<Eigen::Array4d> exact;
  for (int k = 0; k < 4; ++k) {
    exact.value[k] = color.value[k].cast<double>();
    exact.du[k] = color.du[k].cast<double>();
    exact.dv[k] = color.dv[k].cast<double>();
    exact.duv[k] = color.duv[k].cast<double>();
  }
  return exact.at(u, v).max(0).min(1);
}

void expect_within_rounding_of_exact_evaluation(const VectorImage& image) {
  const PatchMesh& patches = image.layers[0].patches;
  Renderer renderer(image);
  for (const double scale : {1.0, 4.0, 16.0, 64.0}) {
    RenderOptions options;
    options.scale = scale;
    const auto [width, height] = output_size(image, options);
    PixelRegion region{0, 0, width, height};
    if (scale > 4) region = {width / 3, height / 3, 150, 120};
    options.region = region;
    const Bytes drawn = draw(renderer, image, options);
    SampleGrid grid;
    grid.scale = {scale, scale};
    const PatchScan scan(patches, grid);
    const SampleWindow window = {region.x, region.y, region.x + region.width,
                                 region.y + region.height};
    double worst = 0;
    int count = 0;
    for (int q = 0; q < patches.patch_count(); ++q) {
      const FergusonPatch patch = ferguson_patch(patches, q);
      scan.scan(q, intersection(scan.bounds(q), window), [&](int y, int begin, int end) {
        for (int x = begin; x < end; ++x) {
          const auto uv = parameters_of(patch.position, {(x + 0.5) / scale, (y + 0.5) / scale});
          const Eigen::Array4d expected = color_at(patch.color, uv.x(), uv.y());
          const std::uint8_t* const pixel =
              drawn.data.data() + (y - region.y) * drawn.row + 4 * (x - region.x);
          for (int k = 0; k < 3; ++k) {
            worst = std::max(worst, std::abs(pixel[k] - 255 * expected[k]));
          }
          ++count;
        }
      });
    }
    EXPECT_EQ(count, region.width * region.height);
    EXPECT_LE(worst, 0.51) << "scale " << scale;
  }
}

TEST(Renderer, IsWithinRoundingOfExactEvaluation) {
  expect_within_rounding_of_exact_evaluation(random_image(3));
}

TEST(Renderer, CutsOffColorsWithinRoundingOfExactEvaluation) {
  const VectorImage image = overshooting_image(3);
  ASSERT_TRUE(image.opaque());
  expect_within_rounding_of_exact_evaluation(image);
}

TEST(Renderer, RegionsThreadsAndFramesGiveTheSameBytes) {
  VectorImage image = random_image(5, false);
  image.layers.push_back(random_image(6, false).layers[0]);
  image.layers[1].transform.rotate(0.4).scale(0.6);
  Renderer renderer(image);
  Random random(2);
  for (const double scale : {0.3, 1.0, 9.0, 30.0}) {
    RenderOptions options;
    options.scale = scale;
    const auto [width, height] = output_size(image, options);
    Renderer fresh(image);
    const Bytes whole = draw(fresh, image, options);
    for (int trial = 0; trial < 12; ++trial) {
      PixelRegion r;
      r.x = random.integer(0, width - 1);
      r.y = random.integer(0, height - 1);
      r.width = random.integer(1, width - r.x);
      r.height = random.integer(1, height - r.y);
      options.region = r;
      const Bytes part = draw(renderer, image, options, {}, 1 + trial % 2);
      bool equal = true;
      for (int y = 0; y < r.height; ++y) {
        equal &=
            std::equal(part.data.begin() + y * part.row, part.data.begin() + (y + 1) * part.row,
                       whole.data.begin() + (y + r.y) * whole.row + 4 * r.x);
      }
      EXPECT_TRUE(equal) << "scale " << scale << " region " << r.x << "," << r.y << "," << r.width
                         << "," << r.height;
    }
  }
}

/// Opaque, with tears among the patches.
VectorImage torn_image(std::uint32_t seed) {
  PatchMesh patches = random_patches(6, 5, 37, 29, seed, {0.25, 0.8});
  QuadMesh& mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); e += 3) {
    if (!mesh.is_border(e)) mesh.edge_flags[e] |= kTearEdge;
  }
  set_random_colors(patches, seed + 100);
  return single_layer(std::move(patches), 37, 29);
}

// Opaque 8-bit pixels of four channels are drawn another way than all others, and large regions
// are written another way than small ones.
TEST(Renderer, ChannelsAndSizeDoNotChangeOpaquePixels) {
  const VectorImage image = torn_image(12);
  ASSERT_TRUE(image.opaque());
  Renderer renderer(image);
  Random random(3);
  for (const double scale : {1.0, 5.0, 33.0}) {
    RenderOptions options;
    options.scale = scale;
    const auto [width, height] = output_size(image, options);
    const Bytes rgb = draw(renderer, image, options, {SampleType::uint8, 3});
    for (int trial = 0; trial < 8; ++trial) {
      PixelRegion r{0, 0, width, height};
      if (trial > 0) {
        r.x = random.integer(0, width - 1), r.y = random.integer(0, height - 1);
        r.width = random.integer(1, width - r.x), r.height = random.integer(1, height - r.y);
      }
      options.region = r;
      const Bytes rgba = draw(renderer, image, options);
      long different = 0;
      for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
          const std::uint8_t* const a = rgba.data.data() + y * rgba.row + 4 * x;
          const std::uint8_t* const b = rgb.data.data() + (r.y + y) * rgb.row + 3 * (r.x + x);
          different += !std::equal(a, a + 3, b) || a[3] != 255;
        }
      }
      EXPECT_EQ(different, 0) << "scale " << scale << " region " << r.x << "," << r.y << ","
                              << r.width << "," << r.height;
    }
  }
}

/// Draws with every instruction set that there is, and fails where their bytes differ.
void expect_same_bytes_of_all_targets(const VectorImage& image, const RenderOptions& options,
                                      const PixelLayout& layout) {
  Renderer best(image);
  const Bytes expected = draw(best, image, options, layout);
  const std::int64_t available = hwy::SupportedTargets();
  for (std::int64_t rest = available; rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().DeInit();
    Renderer renderer(image);
    EXPECT_TRUE(draw(renderer, image, options, layout).data == expected.data)
        << hwy::TargetName(rest & -rest) << " scale " << options.scale << " columns from "
        << (options.region ? options.region->x : 0);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(Renderer, InstructionSetsGiveTheSameBytes) {
  for (const VectorImage& image :
       {random_image(8, false), random_image(8), overshooting_image(8)}) {
    for (const SampleType type : {SampleType::uint8, SampleType::uint16, SampleType::float32}) {
      for (const double scale : {0.5, 1.0, 7.0, 20.0}) {
        RenderOptions options;
        options.scale = scale;
        options.background = {0.2f, 0.4f, 0.6f, 0.5f};
        expect_same_bytes_of_all_targets(image, options, {type, 4});
        if (scale < 5) continue;
        // Windows cut blocks on all sides.
        for (const PixelRegion& region :
             {PixelRegion{13, 9, 61, 47}, PixelRegion{70, 33, 45, 90}}) {
          options.region = region;
          expect_same_bytes_of_all_targets(image, options, {type, 4});
        }
      }
    }
  }
}

TEST(Renderer, DrawsNothingOfAnImageWithALayerThatIsRefused) {
  VectorImage image = random_image(8);
  image.layers.push_back(image.layers[0]);
  image.layers[1].transform.translate(Eigen::Vector2d(NAN, 0));
  Renderer renderer(image);
  for (int frame = 0; frame < 2; ++frame) EXPECT_THROW(draw(renderer, image, {}), Error) << frame;
}

TEST(Renderer, PatchesMayBeWiderThanAnIntTellsSamplesApart) {
  PatchMesh patches = straight_patches(testing::lattice(1, 1, 3.6, 3.6));
  set_linear_colors(patches, Color(0.1f, 0.2f, 0.3f, 1.0f));
  VectorImage image = single_layer(std::move(patches), 1, 1);
  image.layers[0].transform.translate(Eigen::Vector2d(-1.8, -1.8));
  RenderOptions options;
  options.scale = std::ldexp(1.0, 30);
  options.region = PixelRegion{1 << 29, 1 << 29, 64, 64};
  Renderer renderer(image);
  EXPECT_NO_THROW(draw(renderer, image, options));
}

TEST(Renderer, AllocatesNothingInTheSteadyState) {
  const VectorImage image = random_image(4, false);
  Renderer renderer(image);
  RenderOptions options;
  std::vector<std::uint8_t> pixels(4 * 37 * 29 * 16);
  const RunContext one = with_threads(1);
  const auto draw_region = [&](double scale, const PixelRegion& region) {
    options.scale = scale;
    options.region = region;
    renderer.draw(options, {}, {pixels.data(), 4 * region.width}, one);
  };
  const auto draw_all = [&] {
    draw_region(4, {0, 0, 148, 116});
    draw_region(4, {20, 30, 50, 40});
    draw_region(4, {70, 60, 60, 40});
  };
  draw_all();
  const std::size_t before = allocations;
  draw_all();
  EXPECT_EQ(allocations, before);
}

TEST(Renderer, WritesEveryLayout) {
  PatchMesh patches = straight_patches(testing::lattice(2, 2, 8, 6));
  set_linear_colors(patches, Color(0.1f, 0.2f, 0.3f, 0.5f));
  const VectorImage image = single_layer(std::move(patches), 8, 6);
  Renderer renderer(image);
  EXPECT_FALSE(renderer.opaque());
  RenderOptions options;
  EXPECT_THROW(draw(renderer, image, options, {SampleType::uint8, 3}), Error);
  EXPECT_THROW(draw(renderer, image, options, {SampleType::uint8, 2}), Error);
  using Pixel = std::vector<std::uint8_t>;
  const auto first = [&](const PixelLayout& layout) {
    const Bytes drawn = draw(renderer, image, options, layout);
    return Pixel(drawn.data.begin(), drawn.data.begin() + layout.channels);
  };
  EXPECT_EQ(first({SampleType::uint8, 4, false}), (Pixel{51, 102, 153, 128}));
  EXPECT_EQ(first({SampleType::uint8, 4, true}), (Pixel{26, 51, 77, 128}));
  options.background = {1, 1, 1, 1};
  EXPECT_TRUE(renderer.opaque(options));
  EXPECT_EQ(first({SampleType::uint8, 3}), (Pixel{153, 179, 204}));
  const Bytes wide = draw(renderer, image, options, {SampleType::uint16, 3});
  const auto* const words = reinterpret_cast<const std::uint16_t*>(wide.data.data());
  EXPECT_EQ(words[0], std::lround(0.6 * 65535));
}

}  // namespace
}  // namespace quadrille
