// Pictures whose mesh covers a part of their rectangle only, with a curved border and a hole.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "librsvg.h"
#include "quadrille/document.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"
#include "support/programs.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

fs::path output(const std::string& name) { return test::scratch_dir() / ("region_" + name); }

const VectorImage& ring() {
  static const VectorImage image = [] {
    Raster picture(96, 80, 4);
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 96; ++x) {
        const double r = std::hypot(x + 0.5 - 48, y + 0.5 - 40);
        float* p = picture.pixel(x, y);
        p[0] = 0.2f + 0.006f * x;
        p[1] = 0.9f - 0.008f * y;
        p[2] = 0.4f;
        p[3] = static_cast<float>(std::clamp(std::min(r - 13.5, 36.5 - r) + 0.5, 0.0, 1.0));
      }
    }
    return vectorize(picture, {.quads = 200, .region = MeshRegion::opaque}).image;
  }();
  return image;
}

Raster drawn(double scale) {
  RenderOptions options;
  options.scale = scale;
  return render(ring(), options);
}

/// Mean difference of alpha between the pictures.
double alpha_difference(const Raster& a, const Raster& b) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double here = a.has_alpha() ? a.pixel(x, y)[3] : 1;
      const double there = b.has_alpha() ? b.pixel(x, y)[3] : 1;
      sum += std::abs(here - there);
    }
  }
  return sum / a.width / a.height;
}

TEST(OpaqueRegionExport, EveryEndingMakesAFile) {
  for (const std::string& ending : export_endings()) {
    const fs::path path = output("every" + ending);
    export_image(ring(), path);
    EXPECT_GT(fs::file_size(path), 0u) << ending;
    fs::remove(path);
  }
}

TEST(OpaqueRegionExport, PngIsTransparentOutsideAndInTheHole) {
  const fs::path path = output("ring.png");
  export_image(ring(), path);
  const Raster png = load_image(path);
  ASSERT_TRUE(png.has_alpha());
  EXPECT_EQ(png.pixel(0, 0)[3], 0);
  EXPECT_EQ(png.pixel(48, 40)[3], 0);
  EXPECT_EQ(png.pixel(48, 15)[3], 1);
}

TEST(OpaqueRegionExport, DocumentKeepsTheRectangleAndThePatches) {
  const fs::path path = output("ring.quad");
  save_document(ring(), path, {DocumentEncoding::lossless});
  const VectorImage again = load_document(path);
  EXPECT_EQ(again.width, 96);
  EXPECT_EQ(again.height, 80);
  EXPECT_FALSE(again.opaque());
  EXPECT_EQ(render(again), render(ring()));
}

TEST(OpaqueRegionExport, SvgLooksLikeTheRendering) {
  const fs::path svg = output("ring.svg");
  export_image(ring(), svg);
  for (const int scale : {1, 4}) {
    const Raster expected = drawn(scale);
    const Raster seen = test::drawn_by_librsvg(svg, {96 * scale, 80 * scale});
    EXPECT_GT(compare(seen, expected).psnr, 38) << scale;
    EXPECT_LT(alpha_difference(seen, expected), 0.003) << scale;
  }
}

TEST(OpaqueRegionExport, PdfLooksLikeTheRendering) {
  const auto endings = export_endings();
  if (std::find(endings.begin(), endings.end(), ".pdf") == endings.end()) GTEST_SKIP();
  const fs::path pdf = output("ring.pdf"), stem = output("ring_pdf");
  export_image(ring(), pdf);
  constexpr int kScale = 4;
  std::string log;
  ASSERT_EQ(test::run({"pdftocairo", "-png", "-transp", "-singlefile", "-scale-to-x",
                       std::to_string(96 * kScale), "-scale-to-y", std::to_string(80 * kScale), pdf,
                       stem},
                      &log),
            0)
      << log;
  const Raster expected = drawn(kScale);
  const Raster seen = load_image(fs::path(stem).replace_extension(".png"));
  EXPECT_GT(compare(seen, expected).psnr, 34);
  EXPECT_LT(alpha_difference(seen, expected), 0.003);
}

}  // namespace
}  // namespace quadrille
