#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kWidth = 144, kHeight = 96;

class Pdf : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::vector<std::string> endings = export_endings();
    if (std::find(endings.begin(), endings.end(), ".pdf") == endings.end()) {
      GTEST_SKIP() << "built without PDF";
    }
  }

  fs::path output(const std::string& name) const { return test::scratch_dir() / name; }
};

VectorImage random_picture(bool opaque = true, int columns = 9, int rows = 6) {
  PatchMesh patches = testing::random_patches(columns, rows, kWidth, kHeight, 3);
  testing::set_random_colors(patches, 5, opaque);
  patches.opaque = opaque;
  return testing::single_layer(std::move(patches), kWidth, kHeight);
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// By way of export_image, so that the test also links where PDF is left out.
void save(const VectorImage& image, const fs::path& pdf, const PdfOptions& options = {},
          const RunContext& context = {}) {
  ExportOptions all;
  all.pdf = options;
  export_image(image, pdf, all, context);
}

Raster drawn_by_poppler(const fs::path& pdf, int scale) {
  const fs::path stem = fs::path(pdf).replace_extension();
  std::string log;
  EXPECT_EQ(test::run({"pdftoppm", "-png", "-singlefile", "-scale-to-x",
                       std::to_string(static_cast<int>(kWidth) * scale), "-scale-to-y",
                       std::to_string(static_cast<int>(kHeight) * scale), pdf, stem},
                      &log),
            0)
      << log;
  return load_image(stem.string() + ".png");
}

/// poppler draws on white; transparent renderings are compared over white.
ImageDifference difference(const VectorImage& image, const fs::path& pdf, int scale,
                           const PdfOptions& options = {}) {
  save(image, pdf, options);
  RenderOptions as;
  as.scale = scale;
  return compare(drawn_by_poppler(pdf, scale), render(image, as));
}

TEST_F(Pdf, IsSoundAndCompressed) {
  const fs::path pdf = output("check.pdf");
  save(random_picture(), pdf);
  std::string log;
  EXPECT_EQ(test::run({"qpdf", "--check", pdf}, &log), 0) << log;
  EXPECT_THAT(log, HasSubstr("No syntax or stream encoding errors found"));
  EXPECT_THAT(bytes_of(pdf), HasSubstr("/FlateDecode"));
  EXPECT_THAT(bytes_of(pdf), Not(HasSubstr("/CreationDate")));
}

TEST_F(Pdf, ThePageMeasuresThePictureAtItsResolution) {
  PdfOptions options;
  options.dpi = 144;
  options.title = "Grüße";
  save(random_picture(), output("page.pdf"), options);
  std::string log;
  EXPECT_EQ(test::run({"pdfinfo", "-enc", "UTF-8", output("page.pdf")}, &log), 0);
  EXPECT_THAT(log, HasSubstr("72 x 48 pts"));
  EXPECT_THAT(log, HasSubstr("Grüße"));
  EXPECT_THAT(log, HasSubstr("Quadrille"));
}

TEST_F(Pdf, AConstantPictureIsExact) {
  PatchMesh patches = testing::random_patches(5, 4, kWidth, kHeight, 1);
  testing::set_linear_colors(patches, Color(51, 102, 204, 255) / 255);
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  EXPECT_LE(difference(image, output("constant.pdf"), 1).max_error, 1);
  EXPECT_LE(difference(image, output("constant.pdf"), 3).max_error, 1);
}

TEST_F(Pdf, LooksLikeTheRenderingWithinItsTolerance) {
  const VectorImage image = random_picture();
  PdfOptions options;
  for (const double tolerance : {8.0, 4.0, 2.0}) {
    options.tolerance = tolerance;
    // poppler's own steps along the colours cost the rest.
    const double bound = std::min(40.0, 20 * std::log10(255 / (0.5 * tolerance)) - 2.5);
    EXPECT_GT(difference(image, output("random.pdf"), 3, options).psnr, bound) << tolerance;
  }
}

TEST_F(Pdf, CoversThePageWithoutHoles) {
  // Nothing in the picture is as bright as the paper that would shine through.
  PatchMesh patches = testing::random_patches(9, 6, kWidth, kHeight, 6);
  for (std::size_t i = 0; i < patches.wedges.size(); ++i) {
    patches.wedges[i].value = Color(0.4f * float(i % 2), 0.4f * float(i % 3) / 2, 0, 1);
  }
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  save(image, output("holes.pdf"));
  for (const int scale : {1, 3, 5}) {
    const Raster drawn = drawn_by_poppler(output("holes.pdf"), scale);
    float brightest = 0;
    for (int y = 0; y < drawn.height; ++y) {
      for (int x = 0; x < drawn.width; ++x) brightest = std::max(brightest, drawn.pixel(x, y)[2]);
    }
    EXPECT_LT(brightest, 0.02f) << scale;
  }
}

TEST_F(Pdf, TransparencyIsKept) {
  PatchMesh patches = testing::random_patches(9, 6, kWidth, kHeight, 3);
  const float w = static_cast<float>(kWidth);
  testing::set_linear_colors(patches, Color(0.2f, 0.4f, 0, 1),
                             Color(-0.2f / w, -0.4f / w, 0, -1 / w));
  patches.opaque = false;
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  EXPECT_GT(difference(image, output("transparent.pdf"), 4).psnr, 36);
}

TEST_F(Pdf, APictureOfOneQuad) {
  EXPECT_GT(difference(random_picture(true, 1, 1), output("one.pdf"), 4).psnr, 38);
}

TEST_F(Pdf, TheSameBytesForAnyNumberOfThreadsAndAtAnyTime) {
  std::vector<std::string> written;
  for (const int threads : {1, 2, 3}) {
    RunContext context;
    context.threads = threads;
    save(random_picture(false), output("threads.pdf"), {}, context);
    written.push_back(bytes_of(output("threads.pdf")));
    if (threads == 1) test::run({"sleep", "1.1"});  // a new second for whatever writes dates
  }
  EXPECT_TRUE(written[0] == written[1]);
  EXPECT_TRUE(written[0] == written[2]);
}

TEST_F(Pdf, RefusesAResolutionOfZero) {
  PdfOptions options;
  options.dpi = 0;
  EXPECT_THROW(save(random_picture(), output("zero.pdf"), options), Error);
  EXPECT_FALSE(fs::exists(output("zero.pdf")));
}

}  // namespace
}  // namespace quadrille
