// The polynomials of the rasterizer's blocks.
#include "chebyshev_basis.h"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

/// A polynomial of degree 3 both ways.
float bicubic(float x, float y) {
  return 0.3f + 0.2f * x * x * x - 0.4f * x * y * y * y + 0.1f * x * x * x * y * y * y +
         0.25f * x * x * y;
}

template <int kSide>
float on_side(float samples) {
  return 2 * samples / kSide - 1;
}

template <int kSide>
void expect_exact() {
  const ChebyshevBasis<kSide>& basis = kChebyshev<kSide>;
  float series[16];
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      series[4 * j + i] = bicubic(on_side<kSide>(basis.node[i]), on_side<kSide>(basis.node[j]));
    }
  }
  make_series(series);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      float sum = 0;
      for (int n = 0; n < 16; ++n) sum += series[n] * basis.t[n % 4][x] * basis.t[n / 4][y];
      const float right = bicubic(on_side<kSide>(static_cast<float>(x) + 0.5f),
                                  on_side<kSide>(static_cast<float>(y) + 0.5f));
      EXPECT_NEAR(sum, right, 1e-6f) << kSide << ": " << x << ", " << y;
    }
  }
}

TEST(ChebyshevBasis, SeriesThroughTheNodesOfABicubicIsThatBicubic) {
  expect_exact<8>();
  expect_exact<16>();
  expect_exact<32>();
}

template <int kSide>
void expect_even_or_odd() {
  for (int i = 0; i < 4; ++i) {
    const auto& t = kChebyshev<kSide>.t[i];
    for (int x = 0; x < kSide; ++x) {
      EXPECT_EQ(t[kSide - 1 - x], (i % 2 ? -1 : 1) * t[x]) << kSide << ": " << i << ", " << x;
    }
  }
}

TEST(ChebyshevBasis, IsEvenOrOddToTheLastBit) {
  expect_even_or_odd<8>();
  expect_even_or_odd<16>();
  expect_even_or_odd<32>();
}

}  // namespace
}  // namespace quadrille
