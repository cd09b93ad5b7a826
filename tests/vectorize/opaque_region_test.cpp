#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/mesh_region.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"
#include "vectorize/alpha_pictures.h"

namespace quadrille {
namespace {

using testing::disc;
using testing::masked_picture;
namespace fs = std::filesystem;

VectorizeOptions opaque_with(int quads) { return {.quads = quads, .region = MeshRegion::opaque}; }

const QuadMesh& mesh_of(const Vectorization& result) { return result.image.layers[0].patches.mesh; }

Vectorization vectorize_valid(const Raster& picture, const VectorizeOptions& options,
                              const std::string& name = "") {
  Vectorization result = vectorize(picture, options);
  const auto violations = validate_region(mesh_of(result), picture.width, picture.height);
  EXPECT_TRUE(violations.empty()) << name << ": " << violations.front().what;
  EXPECT_EQ(result.report.folded, 0) << name;
  return result;
}

TEST(OpaqueRegion, DiscHasItsAreaAndASmoothBorder) {
  const double r = 60;
  const Raster picture = masked_picture(160, 150, disc(80, 75, r));
  const Vectorization result = vectorize_valid(picture, opaque_with(400));
  EXPECT_EQ(result.report.region, MeshRegion::opaque);
  EXPECT_EQ(result.report.components, 1);
  EXPECT_EQ(result.report.holes, 0);
  EXPECT_NEAR(result.report.quads, 400, 40);
  EXPECT_NEAR(result.report.outline_length, 2 * std::numbers::pi * r, 0.01 * r);
  // The polygon of the border is inscribed; the curves through its vertices are not.
  const double area = std::numbers::pi * r * r;
  EXPECT_NEAR(region_size(mesh_of(result)).area, area, 0.01 * area);
  double covered = 0;
  const Raster drawn = render(result.image);
  for (std::size_t i = 3; i < drawn.data.size(); i += 4) covered += drawn.data[i];
  EXPECT_NEAR(covered, area, 0.002 * area);
  EXPECT_LT(compare(picture, drawn).mae, 0.3);
}

TEST(OpaqueRegion, RingHasOneHole) {
  const Raster picture = masked_picture(120, 120, testing::ring(60, 60, 25, 50));
  const Vectorization result = vectorize_valid(picture, opaque_with(300));
  EXPECT_EQ(result.report.components, 1);
  EXPECT_EQ(result.report.holes, 1);
  const QuadMesh& mesh = mesh_of(result);
  EXPECT_EQ(mesh.vertex_count() - mesh.edge_count() + mesh.quad_count(), 0);
  EXPECT_LT(compare(picture, render(result.image)).mae, 0.5);
}

TEST(OpaqueRegion, ComponentsStayApart) {
  const auto left = disc(40, 50, 30), right = disc(112, 50, 30);
  const Raster picture =
      masked_picture(160, 100, [&](double x, double y) { return left(x, y) || right(x, y); });
  const Vectorization result = vectorize_valid(picture, opaque_with(300));
  EXPECT_EQ(result.report.components, 2);
  EXPECT_EQ(result.report.holes, 0);
}

TEST(OpaqueRegion, BorderLiesOnTheFrameWhereTheOutlineDoes) {
  // A half disc at the left side, and its band along the bottom.
  const auto half = disc(0, 60, 45);
  const Raster picture =
      masked_picture(140, 120, [&](double x, double y) { return half(x, y) || y > 100; });
  const Vectorization result = vectorize_valid(picture, opaque_with(300));
  const QuadMesh& mesh = mesh_of(result);
  double left = 0, bottom = 0, right = 0;
  for (const auto& loop : border_loops(mesh)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d p = mesh.vertices[loop[i]],
                            q = mesh.vertices[loop[(i + 1) % loop.size()]];
      if (p.x() == 0 && q.x() == 0) left += std::abs(q.y() - p.y());
      if (p.x() == 140 && q.x() == 140) right += std::abs(q.y() - p.y());
      if (p.y() == 120 && q.y() == 120) bottom += std::abs(q.x() - p.x());
    }
  }
  EXPECT_NEAR(left, 90 + 15, 1.5);
  EXPECT_NEAR(bottom, 140, 1e-9);
  EXPECT_NEAR(right, 20, 0.5);
  // The pixels along the frame are drawn in full.
  const Raster drawn = render(result.image);
  for (int x = 0; x < 140; ++x) EXPECT_EQ(drawn.pixel(x, 119)[3], 1) << x;
}

TEST(OpaqueRegion, TwentyOneHoles) {
  const auto holed = [](double x, double y) {
    if (std::hypot(x - 150, y - 150) > 140) return false;
    int holes = 0;
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) {
        const bool is_corner = (i == 0 || i == 4) && (j == 0 || j == 4);
        if (is_corner) continue;
        ++holes;
        if (std::hypot(x - 60 - 45 * i, y - 60 - 45 * j) < 11) return false;
      }
    }
    return holes == 21;
  };
  const Raster picture = masked_picture(300, 300, holed);
  const Vectorization result = vectorize_valid(picture, opaque_with(2000));
  EXPECT_EQ(result.report.components, 1);
  EXPECT_EQ(result.report.holes, 21);
  EXPECT_NEAR(result.report.quads, 2000, 200);
  const QuadMesh& mesh = mesh_of(result);
  EXPECT_EQ(mesh.vertex_count() - mesh.edge_count() + mesh.quad_count(), 1 - 21);
}

TEST(OpaqueRegion, AnyAlphaAtAnyCountGivesAValidMesh) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const int w = 1 + random() % 72, h = 1 + random() % 72;
    VectorizeOptions options = opaque_with(std::array{1, 4, 20, 100, 400, 1500}[random() % 6]);
    options.lattice = random() % 5 == 0;
    const Raster picture = testing::random_mask(random, w, h);
    vectorize_valid(picture, options,
                    "case " + std::to_string(i) + ": " + std::to_string(w) + "x" +
                        std::to_string(h) + " at " + std::to_string(options.quads));
  }
}

TEST(OpaqueRegion, ManySpecksAreShedToMeetTheCount) {
  // 20 x 20 discs cannot all be followed with 800 quads.
  const auto dots = [](double x, double y) {
    return std::hypot(std::fmod(x, 12) - 6, std::fmod(y, 12) - 6) < 3.5 ||
           std::hypot(x - 120, y - 120) < 60;
  };
  const Vectorization result = vectorize_valid(masked_picture(240, 240, dots), opaque_with(800));
  EXPECT_LE(result.report.components + result.report.holes, 50);
  EXPECT_NEAR(result.report.quads, 800, 160);
}

TEST(OpaqueRegion, SameAsTheWholeWithoutTransparency) {
  Raster picture(64, 48, 4);
  for (int i = 0; i < 64 * 48; ++i)
    picture.data[4 * i] = i % 64 / 64.0f, picture.data[4 * i + 3] = 1;
  const Vectorization opaque = vectorize(picture, opaque_with(100));
  EXPECT_EQ(opaque.report.region, MeshRegion::whole);
  EXPECT_EQ(to_document(opaque.image), to_document(vectorize(picture, {.quads = 100}).image));
}

TEST(OpaqueRegion, NothingToMeshInATransparentPicture) {
  try {
    vectorize(Raster(32, 32, 4), opaque_with(100));
    FAIL() << "meshed nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::degenerate_input);
  }
}

TEST(OpaqueRegion, RimIsOpaqueAndTheInsideKeepsItsAlpha) {
  Raster picture = masked_picture(120, 120, disc(60, 60, 50));
  const Vectorization opaque = vectorize(picture, opaque_with(300));
  EXPECT_TRUE(opaque.image.layers[0].patches.opaque);
  EXPECT_FALSE(opaque.image.opaque()) << "it does not fill the rectangle";

  for (std::size_t i = 3; i < picture.data.size(); i += 4) picture.data[i] *= 0.75f;
  const Vectorization translucent = vectorize_valid(picture, opaque_with(300));
  EXPECT_FALSE(translucent.image.layers[0].patches.opaque);
  const Raster drawn = render(translucent.image);
  EXPECT_NEAR(drawn.pixel(60, 60)[3], 0.75, 0.01);
  EXPECT_NEAR(drawn.pixel(60, 12)[3], 0.75, 0.02);
  EXPECT_EQ(drawn.pixel(60, 5)[3], 0);
}

TEST(OpaqueRegion, SamplesAreReproducedBetterThanByAMeshOfTheWhole) {
  for (const char* name : {"ring_256_alpha.png", "pepper_256_alpha.png", "flower_256_alpha.png"}) {
    const Raster picture = load_image(fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures" / name);
    // As meshed: a mesh of the whole may move its vertices to the outline afterwards.
    const auto mae = [&](VectorizeOptions options) {
      options.optimize.rounds = 0;
      options.feedback = 0;
      options.tears.mode = TearOptions::Mode::off;
      return compare(picture, render(vectorize(picture, options).image)).mae;
    };
    const double opaque = mae(opaque_with(1000)), whole = mae({.quads = 1000});
    EXPECT_LT(opaque, 0.6 * whole) << name;
    EXPECT_LT(opaque, 1.2) << name;
  }
}

TEST(OpaqueRegion, RingSampleHasItsHoles) {
  const Raster picture =
      load_image(fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures/ring_256_alpha.png");
  for (const int quads : {300, 1000, 3000}) {
    const Vectorization result = vectorize_valid(picture, opaque_with(quads));
    // The middle, and four between the buoy and its rope.
    EXPECT_EQ(result.report.holes, 5);
    EXPECT_NEAR(result.report.quads, quads, 0.1 * quads);
    const CoverageReport coverage = count_coverage(result.image);
    EXPECT_EQ(coverage.doubly_covered, 0);
  }
}

TEST(OpaqueRegion, LatticeIsTrimmedByTheOutline) {
  const Raster picture = masked_picture(120, 120, disc(60, 60, 50));
  VectorizeOptions options = opaque_with(300);
  options.lattice = true;
  const Vectorization result = vectorize_valid(picture, options);
  EXPECT_FALSE(result.report.fallback);
  EXPECT_NEAR(result.report.quads, 300, 30);
}

TEST(OpaqueRegion, DocumentRoundTrip) {
  const Raster picture = masked_picture(120, 90, testing::ring(60, 45, 15, 40));
  const Vectorization result = vectorize(picture, opaque_with(200));
  const DocumentOptions lossless{DocumentEncoding::lossless};
  const std::vector<std::byte> bytes = to_document(result.image, lossless);
  const VectorImage again = from_document(bytes, "ring.quad");
  EXPECT_EQ(again.width, 120);
  EXPECT_EQ(again.height, 90);
  EXPECT_EQ(to_document(again, lossless), bytes);
  EXPECT_EQ(render(again), render(result.image));
}

TEST(OpaqueRegion, SameForAnyNumberOfThreads) {
  const Raster picture =
      load_image(fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures/ring_256_alpha.png");
  const auto document = [&](int threads) {
    return to_document(vectorize(picture, opaque_with(500), {.threads = threads}).image);
  };
  EXPECT_EQ(document(1), document(3));
}

}  // namespace
}  // namespace quadrille
