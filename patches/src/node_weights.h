#pragma once

namespace quadrille {

/// Four Chebyshev nodes on a side of a block, and how much each weighs at the samples' centres.
template <int kSide>
struct NodeWeights {
  float node[4];
  alignas(64) float weight[4][kSide];

  constexpr NodeWeights() : node(), weight() {
    constexpr double kCosine[4] = {-0.92387953251128674, -0.38268343236508977, 0.38268343236508977,
                                   0.92387953251128674};
    for (int i = 0; i < 4; ++i) node[i] = static_cast<float>(kSide / 2.0 * (1 + kCosine[i]));
    for (int i = 0; i < 4; ++i) {
      for (int x = 0; x < kSide; ++x) {
        const double at = (x + 0.5) / (kSide / 2.0) - 1;
        double product = 1;
        for (int j = 0; j < 4; ++j) {
          if (j != i) product *= (at - kCosine[j]) / (kCosine[i] - kCosine[j]);
        }
        weight[i][x] = static_cast<float>(product);
      }
    }
  }
};
template <int kSide>
inline constexpr NodeWeights<kSide> kNodes;

/// The same for every sample of a block of eight, row by row, and where its centre lies.
struct SampleWeights {
  alignas(64) float x[64], y[64], across[4][64], down[4][64];

  constexpr SampleWeights() : x(), y(), across(), down() {
    for (int n = 0; n < 64; ++n) {
      x[n] = static_cast<float>(n % 8) + 0.5f;
      y[n] = static_cast<float>(n / 8) + 0.5f;
      for (int i = 0; i < 4; ++i) {
        across[i][n] = kNodes<8>.weight[i][n % 8];
        down[i][n] = kNodes<8>.weight[i][n / 8];
      }
    }
  }
};
inline constexpr SampleWeights kSamples;

}  // namespace quadrille
