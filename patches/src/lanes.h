#pragma once

#include <cstdlib>  // defines __GLIBC__

// Functions that work on lanes are compiled for several instruction sets, and the best one that the
// machine has is chosen when the program starts. Without fused multiply-adds they give the same
// bits. Sanitizers cannot start with such functions.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define QUADRILLE_MULTIVERSION __attribute__((target_clones("avx2", "default")))
#else
#define QUADRILLE_MULTIVERSION
#endif
#define QUADRILLE_INLINE inline __attribute__((always_inline))

namespace quadrille {

constexpr int kLaneCount = 8;

/// Passed by reference only: how vectors are passed by value depends on the instruction set.
using Lanes = float __attribute__((vector_size(4 * kLaneCount)));

/// The smallest multiple of kLaneCount that is not below count.
constexpr int padded_count(int count) { return (count + kLaneCount - 1) / kLaneCount * kLaneCount; }

}  // namespace quadrille
