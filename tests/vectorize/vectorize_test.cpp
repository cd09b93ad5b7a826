#include "quadrille/vectorize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

void expect_tiles_the_picture(const Vectorization& result, const std::string& name) {
  const VectorImage& image = result.image;
  const auto violations = validate(image.layers[0].patches.mesh, image.width, image.height);
  EXPECT_TRUE(violations.empty()) << name << ": " << violations.front().what;
  EXPECT_EQ(result.report.folded, 0) << name;
  const CoverageReport coverage = count_coverage(image);
  EXPECT_EQ(coverage.uncovered, 0) << name;
  EXPECT_EQ(coverage.doubly_covered, 0) << name;
}

Raster random_picture(std::mt19937& random, int w, int h) {
  Raster picture(w, h, random() % 3 ? 3 : 4);
  const int kind = random() % 5;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      for (int c = 0; c < picture.channels; ++c) {
        float& v = picture.pixel(x, y)[c];
        if (kind == 0) v = (random() % 256) / 255.0f;
        if (kind == 1) v = (x / 3 + y / 2) & 1;
        if (kind == 2) v = x * x + y * y < w * h / 3;
        if (kind == 3) v = static_cast<float>(x) / w;
        if (kind == 4) v = (x + 2 * y) % 3 == 0;
      }
    }
  }
  return picture;
}

TEST(Vectorize, ConstantPictureGivesTheRegularLattice) {
  Raster picture(300, 200, 3);
  std::fill(picture.data.begin(), picture.data.end(), 0.5f);
  const Vectorization result = vectorize(picture, {.quads = 600});
  EXPECT_EQ(result.report.positive_singularities + result.report.negative_singularities, 0);
  EXPECT_EQ(result.report.irregular_vertices, 0);
  EXPECT_EQ(result.report.quads, 30 * 20);
  const QuadMesh& mesh = result.image.layers[0].patches.mesh;
  for (int q = 0; q < mesh.quad_count(); ++q) EXPECT_GT(scaled_jacobian(mesh, q), 0.999);
  EXPECT_LT(compare(picture, render(result.image)).max_error, 1);
}

TEST(Vectorize, RandomSmallPicturesOfAllShapesAreTiledExactlyOnce) {
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const int w = 1 + random() % 64, h = 1 + random() % 64;
    const int quads = std::array{1, 4, 17, 100, 500}[random() % 5];
    const Raster picture = random_picture(random, w, h);
    const std::string name =
        std::to_string(w) + "x" + std::to_string(h) + " at " + std::to_string(quads);
    expect_tiles_the_picture(vectorize(picture, {.quads = quads}), name);
  }
}

TEST(Vectorize, ThinPicturesMeetTheCount) {
  std::mt19937 random(6);
  for (const auto [w, h] : {std::array{1, 1000}, {1000, 1}, {3, 700}, {20, 1500}, {900, 60}}) {
    const Raster picture = random_picture(random, w, h);
    for (const int quads : {30, 200, 1000}) {
      const Vectorization result = vectorize(picture, {.quads = quads});
      const std::string name =
          std::to_string(w) + "x" + std::to_string(h) + " at " + std::to_string(quads);
      expect_tiles_the_picture(result, name);
      EXPECT_NEAR(result.report.quads, quads, 0.1 * quads) << name;
    }
  }
}

class SamplePicture : public testing::TestWithParam<std::string> {};

TEST_P(SamplePicture, IsTiledExactlyOnceWithTheWishedCount) {
  const Raster picture = load_image(fs::path(QUADRILLE_SOURCE_DIR) / "samples" / GetParam());
  const int quads = 1000;
  const Vectorization result = vectorize(picture, {.quads = quads});
  expect_tiles_the_picture(result, GetParam());
  EXPECT_FALSE(result.report.fallback);
  EXPECT_NEAR(result.report.quads, quads, 0.1 * quads);
}

std::vector<std::string> sample_pictures() {
  std::vector<std::string> names;
  const fs::path folder = fs::path(QUADRILLE_SOURCE_DIR) / "samples" / "pictures";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".jpg") {
      names.push_back("pictures/" + entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Samples, SamplePicture, testing::ValuesIn(sample_pictures()),
                         [](const auto& sample) {
                           std::string name = fs::path(sample.param).stem().string();
                           return name;
                         });

TEST(Vectorize, FollowsTheFieldBetterThanTheLattice) {
  // A disc: the field-aligned mesh puts its edges on the contour.
  Raster picture(160, 160, 3);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double d = std::hypot(x + 0.5 - 80, y + 0.5 - 80) - 50;
      for (int c = 0; c < 3; ++c) {
        picture.pixel(x, y)[c] = static_cast<float>(0.2 + 0.6 / (1 + std::exp(2 * d)));
      }
    }
  }
  const auto error = [&](bool lattice) {
    return compare(picture, render(vectorize(picture, {.quads = 400, .lattice = lattice}).image))
        .mae;
  };
  EXPECT_LT(error(false), error(true));
}

TEST(Vectorize, SameImageForAnyNumberOfThreads) {
  const Raster picture =
      load_image(fs::path(QUADRILLE_SOURCE_DIR) / "samples/pictures/pepper_256_alpha.png");
  const auto vertices = [&](int threads) {
    return vectorize(picture, {.quads = 700}, {.threads = threads})
        .image.layers[0]
        .patches.mesh.vertices;
  };
  const auto one = vertices(1);
  EXPECT_EQ(vertices(2), one);
  EXPECT_EQ(vertices(3), one);
}

TEST(LatticeMesh, TilesTheRectangleWithAboutTheWishedCount) {
  for (const auto [w, h] : {std::array{481, 321}, {321, 481}, {1000, 1}, {1, 1000}, {1, 1}}) {
    const QuadMesh mesh = lattice_mesh(w, h, 3000);
    EXPECT_TRUE(validate(mesh, w, h).empty());
    EXPECT_NEAR(mesh.quad_count(), 3000, 60) << w << "x" << h;
  }
  EXPECT_EQ(lattice_mesh(481, 321, 3000).quad_count(), 67 * 45);
}

TEST(Vectorize, RefusesNonsense) { EXPECT_THROW(vectorize(Raster(4, 4, 3), {.quads = 0}), Error); }

TEST(Vectorize, RefusesOptionsOutOfRangeOfStagesThatALatticeLeavesOut) {
  const auto refused = [](const auto& spoil) {
    VectorizeOptions options;
    options.lattice = true;
    spoil(options);
    try {
      quadrangulate(Raster(40, 40, 3), options);
      return false;
    } catch (const Error& error) {
      return error.code() == ErrorCode::invalid_argument;
    }
  };
  EXPECT_FALSE(refused([](VectorizeOptions&) {}));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.cross_field.alignment = 1e9; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.cross_field.cancelling_radius = -1; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.scale.min_ratio = 0; }));
  EXPECT_TRUE(refused(
      [](VectorizeOptions& o) { o.scale.max_ratio = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.position.sweeps = -1; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.position.feature_weight = 2; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.snap.rounds = -1; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.chains.contrast = 0; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.tears.price = -1; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.fit.tolerance = 0; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.fit.max_iterations = 0; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.optimize.rounds = -1; }));
  EXPECT_TRUE(refused([](VectorizeOptions& o) { o.optimize.min_scaled_jacobian = 0; }));
}

TEST(Vectorize, StopsWhenTheObserverSaysSo) {
  RunContext context;
  context.on_progress = [](const std::string&, double) { return false; };
  try {
    vectorize(Raster(64, 64, 3), {.quads = 100}, context);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace quadrille
