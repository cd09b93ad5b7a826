#include "quadrille/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadrille/error.h"

namespace quadrille {
namespace {

Raster noise(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  Raster picture(width, height, channels);
  for (float& v : picture.data) v = static_cast<float>(random() % 256) / 255;
  return picture;
}

/// Structural similarity by its definition, window by window.
double ssim_by_definition(const Raster& a, const Raster& b) {
  const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2);
  double total = 0;
  int windows = 0;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y + 7 <= a.height; ++y) {
      for (int x = 0; x + 7 <= a.width; ++x) {
        double ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
        const auto each = [&](auto f) {
          for (int j = 0; j < 7; ++j) {
            for (int i = 0; i < 7; ++i) {
              f(std::round(a.pixel(x + i, y + j)[c] * 255.0),
                std::round(b.pixel(x + i, y + j)[c] * 255.0));
            }
          }
        };
        each([&](double p, double q) { ma += p / 49, mb += q / 49; });
        each([&](double p, double q) {
          va += (p - ma) * (p - ma) / 48;
          vb += (q - mb) * (q - mb) / 48;
          cov += (p - ma) * (q - mb) / 48;
        });
        total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        ++windows;
      }
    }
  }
  return total / windows;
}

TEST(Metrics, IdenticalPictures) {
  const Raster a = noise(20, 10, 4, 1);
  const ImageDifference d = compare(a, a);
  EXPECT_EQ(d.mae, 0);
  EXPECT_EQ(d.psnr, 99);
  EXPECT_NEAR(d.ssim, 1, 1e-12);
  EXPECT_EQ(d.max_error, 0);
}

TEST(Metrics, AConstantDifferenceGivesItself) {
  Raster a(9, 8, 3), b(9, 8, 3);
  for (float& v : a.data) v = 100 / 255.0f;
  for (float& v : b.data) v = 110 / 255.0f;
  const ImageDifference d = compare(a, b);
  EXPECT_DOUBLE_EQ(d.mae, 10);
  EXPECT_DOUBLE_EQ(d.max_error, 10);
  EXPECT_NEAR(d.psnr, 20 * std::log10(25.5), 1e-12);
  const double c1 = 2.55 * 2.55;
  EXPECT_NEAR(d.ssim, (2 * 100 * 110 + c1) / (100 * 100 + 110 * 110 + c1), 1e-12);
}

TEST(Metrics, SimilarityFollowsItsDefinition) {
  const Raster a = noise(23, 17, 3, 2);
  Raster b = a;
  for (std::size_t i = 0; i < b.data.size(); i += 3) b.data[i] = 1 - b.data[i] / 2;
  EXPECT_NEAR(compare(a, b).ssim, ssim_by_definition(a, b), 1e-10);
  EXPECT_NEAR(compare(a, noise(23, 17, 3, 3)).ssim, ssim_by_definition(a, noise(23, 17, 3, 3)),
              1e-10);
}

TEST(Metrics, AlphaIsShownOverWhite) {
  Raster clear(8, 8, 4), white(8, 8, 3);
  for (float& v : white.data) v = 1;
  EXPECT_EQ(compare(clear, white).max_error, 0);
  Raster half(8, 8, 4);
  for (int i = 0; i < 64; ++i) half.data[4 * i + 3] = 51 / 255.0f;
  EXPECT_NEAR(compare(half, white).mae, 51, 1e-9);
}

TEST(Metrics, ValuesAreRoundedToEightBits) {
  Raster a(7, 7, 3), b(7, 7, 3);
  for (float& v : b.data) v = 0.49f / 255;
  EXPECT_EQ(compare(a, b).max_error, 0);
  for (float& v : b.data) v = -3;
  EXPECT_EQ(compare(a, b).max_error, 0);
}

TEST(Metrics, SmallPicturesHaveNoSimilarity) {
  EXPECT_TRUE(std::isnan(compare(Raster(6, 9, 3), Raster(6, 9, 3)).ssim));
  EXPECT_NEAR(compare(Raster(7, 7, 3), Raster(7, 7, 3)).ssim, 1, 1e-12);
}

TEST(Metrics, RefusesDifferentSizes) {
  EXPECT_THROW(compare(Raster(2, 3, 3), Raster(3, 2, 3)), Error);
}

}  // namespace
}  // namespace quadrille
