#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "librsvg.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using test::drawn_by_librsvg;
using ::testing::HasSubstr;
using ::testing::Not;

fs::path output(const std::string& name) { return test::scratch_dir() / name; }

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Raster over_nothing(const VectorImage& image, double scale) {
  RenderOptions options;
  options.scale = scale;
  return render(image, options);
}

/// Writes the picture and compares what librsvg makes of it with our own rendering.
ImageDifference difference(const VectorImage& image, double scale, const std::string& name,
                           const SvgOptions& options = {}) {
  const fs::path svg = output(name + ".svg");
  write_svg(image, svg, options);
  const Raster expected = over_nothing(image, scale);
  return compare(drawn_by_librsvg(svg, {expected.width, expected.height}), expected);
}

float smallest_alpha(const Raster& picture) {
  float alpha = 1;
  for (int y = 0; picture.has_alpha() && y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) alpha = std::min(alpha, picture.pixel(x, y)[3]);
  }
  return alpha;
}

VectorImage random_picture(bool opaque = true, int columns = 9, int rows = 6) {
  PatchMesh patches = testing::random_patches(columns, rows, 144, 96, 3);
  testing::set_random_colors(patches, 5, opaque);
  patches.opaque = opaque;
  return testing::single_layer(std::move(patches), 144, 96);
}

TEST(Svg, IsWellFormedXmlWithItsSizeAndTitle) {
  SvgOptions options;
  options.title = "Cats & <dogs> \"2\" \x01";
  const fs::path svg = output("title.svg");
  write_svg(random_picture(), svg, options);
  const std::string text = bytes_of(svg);
  EXPECT_THAT(text, HasSubstr("width=\"144\" height=\"96\" viewBox=\"0 0 144 96\" role=\"img\""));
  EXPECT_THAT(text, HasSubstr("<title>Cats &amp; &lt;dogs&gt; &quot;2&quot; </title>"));
  std::string log;
  EXPECT_EQ(test::run({"python3", "-c",
                       "import sys, xml.dom.minidom as m; d = m.parse(sys.argv[1]); ids = "
                       "[g.getAttribute('id') for g in d.getElementsByTagName('linearGradient')]; "
                       "assert len(ids) > 10 and len(ids) == len(set(ids))",
                       svg},
                      &log),
            0)
      << log;
}

TEST(Svg, AConstantPictureIsExact) {
  PatchMesh patches = testing::random_patches(5, 4, 50, 40, 1);
  testing::set_linear_colors(patches, Color(51, 102, 204, 255) / 255);
  const VectorImage image = testing::single_layer(std::move(patches), 50, 40);
  EXPECT_EQ(difference(image, 1, "constant").max_error, 0);
  EXPECT_EQ(difference(image, 3, "constant").max_error, 0);
}

/// Squared 8-bit error, summed over square pixels, by which a byte of the file must lower it.
double price(SvgLevel level) {
  const double tolerance = level == SvgLevel::compact ? 4 : level == SvgLevel::balanced ? 1.5 : 0.8;
  return tolerance * tolerance;
}

constexpr SvgLevel kLevels[] = {SvgLevel::compact, SvgLevel::balanced, SvgLevel::faithful};

double mean_squared_error(const ImageDifference& difference) {
  return 255 * 255 / std::pow(10, difference.psnr / 10);
}

TEST(Svg, ALinearPictureErrsByTheBytesThatExactFillsWouldTake) {
  constexpr int kPatches = 20;
  PatchMesh patches = testing::random_patches(5, 4, 100, 80, 1);
  testing::set_linear_colors(patches, Color(0.1f, 0.9f, 0.3f, 1), Color(0.008f, -0.002f, 0, 0),
                             Color(0, -0.006f, 0.004f, 0));
  const VectorImage image = testing::single_layer(std::move(patches), 100, 80);
  // Two gradients of two stops each show linear colours. With the outline twice that is less than
  // this in a compressed file, so no patch may err by more than the price of it.
  constexpr double kBytes = 100;
  // Stops, drawing and rendering each round by at most half a step; the lower gradient's stops
  // count in part, and so do the upper one's.
  constexpr double kRounding = 1.5 * 1.5;
  for (const SvgLevel level : kLevels) {
    SvgOptions options;
    options.level = level;
    const double most = price(level) * kBytes * kPatches / (100 * 80) + kRounding;
    for (const double scale : {1.0, 4.0}) {
      EXPECT_LT(mean_squared_error(difference(image, scale, "linear", options)), most) << scale;
    }
  }
}

TEST(Svg, ALowerTolerancePaysBytesForLessError) {
  const VectorImage image = random_picture();
  double error = 255 * 255;
  std::uintmax_t bytes = 0;
  for (const SvgLevel level : kLevels) {
    SvgOptions options;
    options.level = level;
    const double now = mean_squared_error(difference(image, 3, "random", options));
    const std::uintmax_t takes = fs::file_size(output("random.svg"));
    EXPECT_LT(now, error);
    EXPECT_GT(takes, bytes);
    error = now;
    bytes = takes;
  }
}

TEST(Svg, SeamsDoNotLetTheBackgroundThrough) {
  const fs::path svg = output("seams.svg");
  write_svg(random_picture(), svg);
  for (const int scale : {1, 2, 3, 7}) {
    const Raster drawn = drawn_by_librsvg(svg, {144 * scale, 96 * scale});
    double open = 0;
    for (int y = 0; drawn.has_alpha() && y < drawn.height; ++y) {
      for (int x = 0; x < drawn.width; ++x) open += 255 * (1 - drawn.pixel(x, y)[3]);
    }
    EXPECT_LT(open / (drawn.width * drawn.height), 0.05) << scale;
    EXPECT_GT(smallest_alpha(drawn), 0.85) << scale;
  }
}

TEST(Svg, APictureOfOneQuad) {
  const VectorImage image = random_picture(true, 1, 1);
  EXPECT_GT(difference(image, 2, "one").psnr, 40);
  EXPECT_EQ(smallest_alpha(drawn_by_librsvg(output("one.svg"), {288, 192})), 1);
}

TEST(Svg, TransparencyIsKept) {
  const VectorImage image = random_picture(false);
  for (const double scale : {1.0, 4.0}) {
    EXPECT_GT(difference(image, scale, "transparent").psnr, 38) << scale;
  }
  const Raster drawn = drawn_by_librsvg(output("transparent.svg"), {576, 384});
  const Raster expected = over_nothing(image, 4);
  ASSERT_TRUE(drawn.has_alpha() && expected.has_alpha());
  double squared = 0;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      squared += std::pow(255 * (drawn.pixel(x, y)[3] - expected.pixel(x, y)[3]), 2);
    }
  }
  EXPECT_LT(std::sqrt(squared / (drawn.width * drawn.height)), 3);
}

TEST(Svg, OpaqueAndTransparentPartsMeetWithoutASeam) {
  PatchMesh patches = testing::random_patches(6, 4, 60, 40, 4);
  testing::set_linear_colors(patches, Color(0.2f, 0.6f, 0.4f, 1));
  patches.opaque = false;
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const double x = patches.mesh.vertices[patches.mesh.origin(h)].x();
    if (x > 40) patches.wedges[patches.wedge_of_corner[h]].value = Color::Zero();
  }
  const VectorImage image = testing::single_layer(std::move(patches), 60, 40);
  EXPECT_GT(difference(image, 4, "fade").psnr, 40);
}

TEST(Svg, LayersAreTransformed) {
  VectorImage image = random_picture();
  Layer above;
  above.patches = testing::random_patches(3, 2, 30, 20, 8);
  testing::set_linear_colors(above.patches, Color(0.9f, 0.1f, 0.1f, 1));
  above.transform.translate(Eigen::Vector2d(40, 30)).rotate(0.5).scale(2);
  image.layers.push_back(above);
  EXPECT_GT(difference(image, 4, "layers").psnr, 38);
}

TEST(Svg, TheSameBytesForAnyNumberOfThreads) {
  const VectorImage image = random_picture(false);
  std::vector<std::string> written;
  for (const int threads : {1, 2, 3}) {
    RunContext context;
    context.threads = threads;
    write_svg(image, output("threads.svg"), {}, context);
    written.push_back(bytes_of(output("threads.svg")));
  }
  EXPECT_EQ(written[0], written[1]);
  EXPECT_EQ(written[0], written[2]);
}

TEST(Svg, TearsDivideALayerIntoRegions) {
  PatchMesh patches = testing::random_patches(6, 4, 60, 40, 4);
  QuadMesh mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e), twin = mesh.twin(h);
    if (twin < 0) continue;
    const bool left = QuadMesh::quad_of(h) % 6 < 3, other_left = QuadMesh::quad_of(twin) % 6 < 3;
    if (left != other_left) mesh.edge_flags[e] |= kTearEdge;
  }
  PatchMesh torn = straight_patches(mesh);
  testing::set_linear_colors(torn, Color(0.2f, 0.6f, 0.4f, 1));
  const fs::path svg = output("regions.svg");
  write_svg(testing::single_layer(std::move(torn), 60, 40), svg);
  const std::string text = bytes_of(svg);
  EXPECT_THAT(text, HasSubstr("<g id=\"layer-1\">"));
  EXPECT_THAT(text, HasSubstr("<g id=\"region-1\">"));
  EXPECT_THAT(text, HasSubstr("<g id=\"region-2\">"));
  EXPECT_THAT(text, Not(HasSubstr("region-3")));
}

/// Two halves of different colours, each a little uneven so that it takes many cells; across the
/// tear between them nothing is shared.
VectorImage halves(const Color& left, const Color& right) {
  PatchMesh patches = testing::random_patches(10, 6, 100, 60, 7);
  QuadMesh mesh = patches.mesh;
  const auto is_left = [](int quad) { return quad % 10 < 5; };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e), twin = mesh.twin(h);
    if (twin >= 0 && is_left(QuadMesh::quad_of(h)) != is_left(QuadMesh::quad_of(twin))) {
      mesh.edge_flags[e] |= kTearEdge;
    }
  }
  PatchMesh torn = straight_patches(mesh);
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    Wedge& wedge = torn.wedges[torn.wedge_of_corner[h]];
    const float shade = 0.8f + 0.2f * static_cast<float>(mesh.origin(h) % 3) / 2;
    wedge.value = (is_left(QuadMesh::quad_of(h)) ? left : right) * Color(shade, shade, shade, 1);
  }
  torn.opaque = left[3] == 1 && right[3] == 1;
  return testing::single_layer(std::move(torn), 100, 60);
}

TEST(Svg, PixelsThatATearHalvesAreCoveredOnceFromEachSide) {
  const VectorImage image = halves(Color(0.9f, 0.8f, 0.2f, 1), Color(0.1f, 0.1f, 0.4f, 1));
  EXPECT_GT(difference(image, 1, "torn").psnr, 44);
  EXPECT_GT(difference(image, 4, "torn").psnr, 44);
  EXPECT_EQ(smallest_alpha(drawn_by_librsvg(output("torn.svg"), {400, 240})), 1);
}

TEST(Svg, PixelsThatAnOutlineHalvesAreCoveredOnce) {
  const VectorImage image = halves(Color(0.9f, 0.8f, 0.2f, 1), Color::Zero());
  EXPECT_GT(difference(image, 1, "half").psnr, 44);
  EXPECT_GT(difference(image, 4, "half").psnr, 44);
  EXPECT_THAT(bytes_of(output("half.svg")), HasSubstr("<mask id=\"region-1-mask-1\" "));
}

TEST(Svg, FaintColoursDoNotMixWithStrongOnesAtATear) {
  for (const bool faint_first : {true, false}) {
    const Color strong(0.85f, 0.75f, 0.2f, 0.9f), faint(0, 0.02f, 0.1f, 0.1f);
    const VectorImage image = faint_first ? halves(faint, strong) : halves(strong, faint);
    EXPECT_GT(difference(image, 1, "faint").psnr, 44) << faint_first;
    // The strong colours hide a strip of the faint ones, wider than a pixel at this scale.
    EXPECT_GT(difference(image, 4, "faint").psnr, 42) << faint_first;
  }
}

TEST(Svg, HybridImagesAreSharpAtTearsAndOutlines) {
  for (const bool is_torn_picture : {true, false}) {
    const VectorImage image = halves(Color(0.9f, 0.8f, 0.2f, 1),
                                     is_torn_picture ? Color(0.1f, 0.1f, 0.4f, 1) : Color::Zero());
    const fs::path svg = output("hybrid.svg");
    write_svg(image, svg, {.level = SvgLevel::hybrid});
    for (const int scale : {1, 4}) {
      const Raster expected = render(image, {.scale = double(scale)});
      const Raster drawn = drawn_by_librsvg(svg, {100 * scale, 60 * scale});
      EXPECT_GT(compare(drawn, expected).psnr, 40) << scale;
    }
    EXPECT_THROW(write_svg(image, svg, {.level = SvgLevel::hybrid, .size_limit = 1000}), Error);
  }
}

TEST(Svg, HybridKeepsTransparency) {
  const VectorImage image = halves(Color(0.45f, 0.4f, 0.1f, 0.5f), Color(0.1f, 0.1f, 0.4f, 1));
  const fs::path svg = output("hybrid.svg");
  write_svg(image, svg, {.level = SvgLevel::hybrid});
  EXPECT_GT(compare(drawn_by_librsvg(svg, {100, 60}), render(image)).psnr, 38);
}

}  // namespace
}  // namespace quadrille
