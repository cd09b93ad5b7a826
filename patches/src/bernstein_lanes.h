#pragma once

#include <cstring>

#include "lanes.h"

namespace quadrille {

QUADRILLE_INLINE void load(const float* from, Lanes& to) { std::memcpy(&to, from, sizeof to); }
QUADRILLE_INLINE void store(const Lanes& from, float* to) { std::memcpy(to, &from, sizeof from); }

/// Sums of neighbouring lanes within each half: of a and b in turns of two.
QUADRILLE_INLINE void pair_sums(const Lanes& a, const Lanes& b, Lanes& sums) {
  sums = __builtin_shufflevector(a, b, 0, 2, 8, 10, 4, 6, 12, 14) +
         __builtin_shufflevector(a, b, 1, 3, 9, 11, 5, 7, 13, 15);
}

/// totals[i] = the sum over all lanes of x[i]. Together they take a quarter of the shuffles that
/// they take one by one.
QUADRILLE_INLINE void sum_lanes(const Lanes* x, float (&totals)[kLaneCount]) {
  Lanes pairs[4], low, high;
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) pair_sums(x[2 * i], x[2 * i + 1], pairs[i]);
  pair_sums(pairs[0], pairs[1], low);
  pair_sums(pairs[2], pairs[3], high);
  store(__builtin_shufflevector(low, high, 0, 1, 2, 3, 8, 9, 10, 11) +
            __builtin_shufflevector(low, high, 4, 5, 6, 7, 12, 13, 14, 15),
        totals);
}

/// sums[i] += the sum over all lanes of x[i], i < Count; x is filled up with zeros.
template <int Count>
QUADRILLE_INLINE void add_sums(const Lanes (&x)[padded_count(Count)], double* sums) {
  float totals[kLaneCount];
  for (int first = 0; first + kLaneCount <= Count; first += kLaneCount) {
    sum_lanes(x + first, totals);
#pragma GCC unroll 8
    for (int i = 0; i < kLaneCount; ++i) sums[first + i] += totals[i];
  }
  constexpr int kRest = Count % kLaneCount;
  if constexpr (kRest > 0) {
    sum_lanes(x + Count - kRest, totals);
    for (int i = 0; i < kRest; ++i) sums[Count - kRest + i] += totals[i];
  }
}

/// sums[N j + i] += the sum over all lanes of values v_j u_i.
template <int N>
QUADRILLE_INLINE void add_products(int groups, const Lanes* values, const Lanes (*u)[N],
                                   const Lanes (*v)[N], double* sums) {
  Lanes products[padded_count(N * N)];
  for (int i = N * N; i < padded_count(N * N); ++i) products[i] = Lanes{};
  for (int j = 0; j < N; ++j) {
    Lanes sum[N] = {};
    for (int g = 0; g < groups; ++g) {
      const Lanes row = values[g] * v[g][j];
#pragma GCC unroll 8
      for (int i = 0; i < N; ++i) sum[i] += row * u[g][i];
    }
#pragma GCC unroll 8
    for (int i = 0; i < N; ++i) products[N * j + i] = sum[i];
  }
  add_sums<N * N>(products, sums);
}

/// Exchanges rows and columns of both halves, blocks of 4 x 4.
QUADRILLE_INLINE void transpose_blocks(const Lanes (&in)[4], Lanes (&out)[4]) {
  const Lanes low01 = __builtin_shufflevector(in[0], in[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high01 = __builtin_shufflevector(in[0], in[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes low23 = __builtin_shufflevector(in[2], in[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high23 = __builtin_shufflevector(in[2], in[3], 2, 10, 3, 11, 6, 14, 7, 15);
  out[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  out[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Loads kLaneCount times four channels, channel by channel; number p lies at floats(p).
template <class Floats>
QUADRILLE_INLINE void load_channels(const Floats& floats, Lanes (&channel)[4]) {
  using Four = float __attribute__((vector_size(16)));
  Four part[kLaneCount];
#pragma GCC unroll 8
  for (int p = 0; p < kLaneCount; ++p) std::memcpy(&part[p], floats(p), sizeof part[p]);
  Lanes row[4];
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
    row[p] = __builtin_shufflevector(part[p], part[p + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  transpose_blocks(row, channel);
}

/// The cubic Bernstein polynomials at t.
QUADRILLE_INLINE void cubic_bernstein(const Lanes& t, Lanes (&b)[4]) {
  const Lanes s = 1.0f - t, s2 = s * s, t2 = t * t;
  b[0] = s2 * s;
  b[1] = 3.0f * s2 * t;
  b[2] = 3.0f * s * t2;
  b[3] = t2 * t;
}

}  // namespace quadrille
