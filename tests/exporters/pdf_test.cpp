#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
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

TEST_F(Pdf, ATitleOfAnyBytesIsText) {
  PdfOptions options;
  options.title = "a\xFF\xC3(b";
  save(random_picture(), output("title.pdf"), options);
  std::string log;
  EXPECT_EQ(test::run({"qpdf", "--check", output("title.pdf")}, &log), 0) << log;
  EXPECT_EQ(test::run({"pdfinfo", "-enc", "UTF-8", output("title.pdf")}, &log), 0);
  EXPECT_THAT(log, HasSubstr("a\xEF\xBF\xBD\xEF\xBF\xBD(b"));
}

TEST_F(Pdf, AConstantPictureIsExact) {
  PatchMesh patches = testing::random_patches(5, 4, kWidth, kHeight, 1);
  testing::set_linear_colors(patches, Color(51, 102, 204, 255) / 255);
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  EXPECT_LE(difference(image, output("constant.pdf"), 1).max_error, 1);
  EXPECT_LE(difference(image, output("constant.pdf"), 3).max_error, 1);
}

TEST_F(Pdf, LinearColorsAreExact) {
  // Over straight edges they are bilinear in each patch, as the shading's are.
  PatchMesh patches = testing::random_patches(5, 4, kWidth, kHeight, 1, {.curvature = 0});
  const float w = static_cast<float>(kWidth), h = static_cast<float>(kHeight);
  testing::set_linear_colors(patches, Color(0.1f, 0.9f, 0.4f, 1), Color(0.8f / w, 0, 0, 0),
                             Color(0, -0.7f / h, 0, 0));
  const VectorImage image = testing::single_layer(std::move(patches), kWidth, kHeight);
  const fs::path pdf = output("linear.pdf"), stem = output("linear");
  PdfOptions options;
  options.tolerance = 0.75;
  save(image, pdf, options);
  ASSERT_EQ(test::run({"pdftocairo", "-png", "-singlefile", "-r", "288", pdf, stem}), 0);
  RenderOptions as;
  as.scale = 3;
  // Twice the tolerance, 3/8 of a step of rounding up, and rounding to 8 bits here and in cairo.
  EXPECT_LE(compare(load_image(stem.string() + ".png"), render(image, as)).max_error, 3);
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

TEST_F(Pdf, CoversThePageToItsBorder) {
  const fs::path pdf = output("border.pdf"), stem = output("border");
  save(random_picture(), pdf);
  for (const int scale : {1, 2, 5}) {
    ASSERT_EQ(test::run({"pdftocairo", "-png", "-transp", "-singlefile", "-r",
                         std::to_string(96 * scale), pdf, stem}),
              0);
    const Raster drawn = load_image(stem.string() + ".png");
    ASSERT_EQ(drawn.width, static_cast<int>(kWidth) * scale);
    for (int y = 0; drawn.has_alpha() && y < drawn.height; ++y) {
      for (int x = 0; x < drawn.width; ++x) ASSERT_EQ(drawn.pixel(x, y)[3], 1) << x << ' ' << y;
    }
  }
}

/// Black to the left of the middle, white to its right: torn from top to bottom, or down to the
/// height where a tear ends inside the picture and the colours meet.
VectorImage torn_picture(double end) {
  constexpr int kColumns = 6, kRows = 4;
  QuadMesh mesh = testing::lattice(kColumns, kRows, kWidth, kHeight);
  const auto is_middle = [](const Eigen::Vector2d& p) { return p.x() == kWidth / 2; };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const Eigen::Vector2d &a = mesh.vertices[mesh.origin(mesh.halfedge(e))],
                          &b = mesh.vertices[mesh.tip(mesh.halfedge(e))];
    const bool torn = is_middle(a) && is_middle(b) && std::max(a.y(), b.y()) <= end;
    if (torn) mesh.edge_flags[e] |= kTearEdge;
  }
  PatchMesh patches = straight_patches(std::move(mesh));
  for (int q = 0; q < patches.patch_count(); ++q) {
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d& p = patches.mesh.vertices[patches.mesh.quads()[q][k]];
      const bool meets = is_middle(p) && p.y() >= end && end < kHeight;
      const float gray = meets ? 0.5f : q % kColumns < kColumns / 2 ? 0.0f : 1.0f;
      patches.wedges[patches.wedge_of_corner[4 * q + k]].value = Color(gray, gray, gray, 1);
    }
  }
  return testing::single_layer(std::move(patches), kWidth, kHeight);
}

TEST_F(Pdf, ATearStaysSharp) {
  for (const double end : {kHeight, kHeight / 2}) {
    const VectorImage image = torn_picture(end);
    save(image, output("tear.pdf"));
    constexpr int kScale = 3, kMiddle = static_cast<int>(kWidth) * kScale / 2;
    const Raster drawn = drawn_by_poppler(output("tear.pdf"), kScale);
    for (int y = 0; y < drawn.height / 4; ++y) {
      ASSERT_LT(drawn.pixel(kMiddle - 2, y)[0], 0.02f) << y;
      ASSERT_GT(drawn.pixel(kMiddle + 1, y)[0], 0.98f) << y;
    }
    EXPECT_GT(difference(image, output("tear.pdf"), kScale).psnr, 36) << end;
  }
}

TEST_F(Pdf, HostileMeshesAreSound) {
  std::vector<VectorImage> images;
  images.push_back(random_picture(true, 1, 1));
  images.push_back(random_picture(false, 4, 3));  // made fully transparent
  for (Wedge& wedge : images.back().layers[0].patches.wedges) wedge = Wedge{};
  for (const double share : {0.0, -1.5}) {  // an edge without length, folds
    PatchMesh patches = testing::random_patches(6, 4, kWidth, kHeight, 8);
    auto& vertices = patches.mesh.vertices;
    vertices[16] = vertices[17] + share * (vertices[16] - vertices[17]);
    for (auto& ends : patches.edge_tangents) ends[0] *= 3;
    testing::set_random_colors(patches, 9);
    images.push_back(testing::single_layer(std::move(patches), kWidth, kHeight));
  }
  for (const double far : {std::nan(""), HUGE_VAL, 1e300, -1e9}) {
    for (const bool opaque : {true, false}) {
      images.push_back(random_picture(opaque));
      images.back().layers[0].patches.mesh.vertices[25] = Eigen::Vector2d(far, far);
    }
  }
  images.push_back({kWidth, kHeight, {}, {}});
  for (std::size_t i = 0; i < images.size(); ++i) {
    save(images[i], output("hostile.pdf"));
    std::string log;
    EXPECT_EQ(test::run({"qpdf", "--check", output("hostile.pdf")}, &log), 0) << i << log;
    drawn_by_poppler(output("hostile.pdf"), 1);
    export_image(images[i], output("hostile.ps"));
  }
}

TEST_F(Pdf, TheUnderlayOfAThinLayerHasAPixelPerPatch) {
  PatchMesh patches = straight_patches(testing::lattice(4, 1, 9e6, 1e-12));
  testing::set_linear_colors(patches, Color(0.2f, 0.3f, 0.4f, 1));
  save(testing::single_layer(std::move(patches), kWidth, kHeight), output("thin.pdf"));
  EXPECT_THAT(bytes_of(output("thin.pdf")), HasSubstr("/Width 4 "));
}

TEST_F(Pdf, AHundredThousandQuads) {
  PatchMesh patches = straight_patches(testing::lattice(400, 250, 1600, 1000));
  testing::set_linear_colors(patches, Color(0.2f, 0.3f, 0.4f, 1), Color(2e-4f, 0, 0, 0));
  const VectorImage image = testing::single_layer(std::move(patches), 1600, 1000);
  save(image, output("many.pdf"));
  EXPECT_EQ(test::run({"qpdf", "--check", output("many.pdf")}), 0);
  EXPECT_LT(fs::file_size(output("many.pdf")), 3'000'000u);
}

TEST_F(Pdf, CancellingLeavesNoFile) {
  RunContext context;
  for (const double until : {0.0, 0.5, 0.96}) {
    context.on_progress = [&](const std::string&, double part) { return part < until; };
    EXPECT_THROW(save(random_picture(), output("cancelled.pdf"), {}, context), Error) << until;
    EXPECT_FALSE(fs::exists(output("cancelled.pdf"))) << until;
  }
  context.on_progress = [](const std::string&, double) { return false; };
  for (const char* name : {"cancelled.pdf", "cancelled.ps"}) {
    EXPECT_THROW(export_image(random_picture(), output(name), {}, context), Error);
    EXPECT_FALSE(fs::exists(output(name)));
  }
}

/// While it lives, files of this process cannot grow beyond some bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(Pdf, AFullDiskUnderTheTemporaryFileIsNamed) {
  // The data of one quad are still in memory when the file is put together, those of many are not.
  for (const int columns : {1, 60}) {
    for (const char* name : {"full.pdf", "full.ps"}) {
      const VectorImage image = random_picture(true, columns, columns);
      std::string message;
      {
        const FileSizeLimit nothing(0);
        try {
          export_image(image, output(name));
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::io_failure);
          message = error.what();
        }
      }
      EXPECT_THAT(message, HasSubstr("cannot write '" + output(name).string() +
                                     "': a temporary file beside it cannot be written"));
      EXPECT_FALSE(fs::exists(output(name)));
    }
  }
}

TEST_F(Pdf, PostScriptShowsTheSameOverWhite) {
  if (!test::has_program("gs")) GTEST_SKIP() << "no ghostscript";
  for (const bool opaque : {true, false}) {
    for (const std::string ending : {".ps", ".eps"}) {
      const VectorImage image = random_picture(opaque);
      const fs::path file = output("script" + ending), png = output("script.png");
      export_image(image, file);
      std::string log;
      ASSERT_EQ(test::run({"gs", "-q", "-dNOPAUSE", "-dBATCH", "-dSAFER", "-dEPSCrop", "-r288",
                           "-sDEVICE=png16m", "-sOutputFile=" + png.string(), file},
                          &log),
                0)
          << log;
      RenderOptions as;
      as.scale = 3;
      const Raster drawn = load_image(png);
      ASSERT_EQ(drawn.width, 3 * static_cast<int>(kWidth));
      EXPECT_GT(compare(drawn, render(image, as)).psnr, 36) << opaque << ending;
    }
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

/// 100000 is 1e5 in few characters, which is no number in PDF.
TEST_F(Pdf, RoundSizesOfTransparentPicturesAreNumbers) {
  PatchMesh patches = testing::random_patches(3, 2, 100000, 8, 3);
  testing::set_random_colors(patches, 5, false);
  patches.opaque = false;
  std::string log;
  save(testing::single_layer(std::move(patches), 100000, 8), output("wide.pdf"));
  EXPECT_EQ(test::run({"qpdf", "--check", output("wide.pdf")}, &log), 0) << log;
}

TEST_F(Pdf, APictureOfOneQuad) {
  const VectorImage image = random_picture(true, 1, 1);
  const fs::path pdf = output("one.pdf"), stem = output("one");
  save(image, pdf);
  ASSERT_EQ(test::run({"pdftocairo", "-png", "-singlefile", "-r", "384", pdf, stem}), 0);
  RenderOptions as;
  as.scale = 4;
  EXPECT_GT(compare(load_image(stem.string() + ".png"), render(image, as)).psnr, 38);
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
