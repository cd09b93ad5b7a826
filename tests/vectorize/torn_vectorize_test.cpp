// The whole way with chains torn or not.
#include <gtest/gtest.h>

#include "box_filtered.h"
#include "quadrille/document.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace {

using Mode = TearOptions::Mode;

Raster picture() { return test::disc_picture(96, 80, {47.3, 40.6}, 25); }

Vectorization vectorized(Mode mode, int threads = 0) {
  VectorizeOptions options{.quads = 300};
  options.tears.mode = mode;
  return vectorize(picture(), options, {.threads = threads});
}

TEST(TornVectorize, TearsSharpenADisc) {
  const Raster original = picture();
  const auto psnr = [&](const Vectorization& v) { return compare(original, render(v.image)).psnr; };
  const Vectorization off = vectorized(Mode::off), automatic = vectorized(Mode::automatic),
                      strong = vectorized(Mode::strong);
  EXPECT_EQ(off.report.tears, 0);
  EXPECT_EQ(off.report.chains, 0);
  EXPECT_EQ(automatic.report.tears, 1);
  EXPECT_EQ(strong.report.tears, 1);
  EXPECT_NEAR(strong.report.tear_length, 2 * 3.14159 * 25, 8);
  constexpr double kGain = 1;  // dB
  EXPECT_GE(psnr(automatic), psnr(off) + kGain);
  EXPECT_GE(psnr(strong), psnr(off) + kGain);
  for (const Vectorization* v : {&off, &automatic, &strong}) {
    EXPECT_EQ(v->report.folded, 0);
    EXPECT_TRUE(validate(v->image.layers[0].patches.mesh, 96, 80).empty());
    EXPECT_EQ(count_coverage(v->image).uncovered, 0);
  }
}

TEST(TornVectorize, SameBytesForAnyNumberOfThreads) {
  const auto one = to_document(vectorized(Mode::automatic, 1).image);
  EXPECT_EQ(to_document(vectorized(Mode::automatic, 2).image), one);
  EXPECT_EQ(to_document(vectorized(Mode::automatic, 4).image), one);
}

}  // namespace
}  // namespace quadrille
