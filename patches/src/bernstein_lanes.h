#pragma once

#include <cstring>

#include "lanes.h"

namespace quadrille {

QUADRILLE_INLINE void load(const float* from, Lanes& to) { std::memcpy(&to, from, sizeof to); }
QUADRILLE_INLINE void store(const Lanes& from, float* to) { std::memcpy(to, &from, sizeof from); }

/// The sum over all lanes.
QUADRILLE_INLINE float sum_of(const Lanes& x) {
  using Order = int __attribute__((vector_size(4 * kLaneCount)));
  const Lanes halves = x + __builtin_shuffle(x, Order{4, 5, 6, 7, 0, 1, 2, 3});
  const Lanes quarters = halves + __builtin_shuffle(halves, Order{2, 3, 0, 1, 6, 7, 4, 5});
  return quarters[0] + quarters[1];
}

/// sums[N j + i] += the sum over all lanes of values v_j u_i.
template <int N>
QUADRILLE_INLINE void add_products(int groups, const Lanes* values, const Lanes (*u)[N],
                                   const Lanes (*v)[N], double* sums) {
  for (int j = 0; j < N; ++j) {
    Lanes sum[N] = {};
    for (int g = 0; g < groups; ++g) {
      const Lanes row = values[g] * v[g][j];
#pragma GCC unroll 8
      for (int i = 0; i < N; ++i) sum[i] += row * u[g][i];
    }
#pragma GCC unroll 8
    for (int i = 0; i < N; ++i) sums[N * j + i] += sum_of(sum[i]);
  }
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
