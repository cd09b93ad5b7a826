#pragma once

#include <utility>

namespace quadrille {

/// Bicubic polynomials on a side of a block as Chebyshev series.
template <int kSide>
struct ChebyshevBasis {
  float node[4];                  ///< the roots of T_4, from the block's side on, in samples
  alignas(64) float t[4][kSide];  ///< T_0 to T_3 at the samples' centres: even, odd, even, odd

  constexpr ChebyshevBasis() : node(), t() {
    constexpr double kCosine[4] = {-0.92387953251128674, -0.38268343236508977, 0.38268343236508977,
                                   0.92387953251128674};
    for (int i = 0; i < 4; ++i) node[i] = static_cast<float>(kSide / 2.0 * (1 + kCosine[i]));
    for (int x = 0; x < kSide; ++x) {
      const double u = (x + 0.5) / (kSide / 2.0) - 1;
      t[0][x] = 1;
      t[1][x] = static_cast<float>(u);
      t[2][x] = static_cast<float>(2 * u * u - 1);
      t[3][x] = static_cast<float>((4 * u * u - 3) * u);
    }
  }
};
template <int kSide>
inline constexpr ChebyshevBasis<kSide> kChebyshev;

/// From 4 x 4 values at the nodes the coefficients of their series, [4 j + i] that of T_i across
/// and T_j down, in their place.
inline void make_series(float* values) {
  constexpr float kQuarter = 0.25f, kDiagonal = 0.35355339f, kLong = 0.46193977f,
                  kShort = 0.19134172f;
  for (const auto& [step, next] : {std::pair(4, 1), std::pair(1, 4)}) {
    for (int i = 0; i < 4; ++i) {
      float* const f = values + next * i;
      const float outer = f[3 * step] + f[0], inner = f[2 * step] + f[step];
      const float wide = f[3 * step] - f[0], narrow = f[2 * step] - f[step];
      f[0] = (outer + inner) * kQuarter;
      f[step] = wide * kLong + narrow * kShort;
      f[2 * step] = (outer - inner) * kDiagonal;
      f[3 * step] = wide * kShort - narrow * kLong;
    }
  }
}

}  // namespace quadrille
