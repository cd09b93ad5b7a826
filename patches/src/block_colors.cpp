#include "block_colors.h"

#include <algorithm>
#include <cstring>

#include "chebyshev_basis.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_colors.cpp"
#include <hwy/foreach_target.h>

#include "block_bound-inl.h"

#ifndef QUADRILLE_BLOCK_COLORS_ONCE
#define QUADRILLE_BLOCK_COLORS_ONCE

namespace quadrille {

/// The basis at every sample of a block of eight, row by row, and where its centre lies.
struct SampleBasis {
  alignas(64) float x[64], y[64], across[4][64], down[4][64];

  constexpr SampleBasis() : x(), y(), across(), down() {
    for (int n = 0; n < 64; ++n) {
      x[n] = static_cast<float>(n % 8) + 0.5f;
      y[n] = static_cast<float>(n / 8) + 0.5f;
      for (int i = 0; i < 4; ++i) {
        across[i][n] = kChebyshev<8>.t[i][n % 8];
        down[i][n] = kChebyshev<8>.t[i][n / 8];
      }
    }
  }
};
inline constexpr SampleBasis kBlockSamples;

}  // namespace quadrille

#endif

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

/// How far outside the square nodes and middles of blocks may lie.
constexpr float kReach = 0.5f;
/// How much steeper than inside the square colours may be at nodes.
constexpr float kSteeper = 2;

struct Normalized {
  V x, y;
};
HWY_INLINE Normalized normalized(const float (&map)[6], const V& x, const V& y) {
  return {(number(map[0]) * x + number(map[1]) * y) + number(map[2]),
          (number(map[3]) * x + number(map[4]) * y) + number(map[5])};
}

void judge(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
           std::span<const ColorBlock> blocks, std::uint8_t* fit) {
  const Floats d;
  constexpr float kAllowed = 1.0f / 130 / 255;
  const float half = static_cast<float>(side) / 2;
  const float sides[2][2] = {{map[0] * half, map[3] * half}, {map[1] * half, map[4] * half}};
  const int lanes = static_cast<int>(hn::Lanes(d)), count = static_cast<int>(blocks.size());
  for (int first = 0; first < count; first += lanes) {
    alignas(64) float xs[16], ys[16], ok[16];
    for (int i = 0; i < lanes; ++i) {
      const ColorBlock& block = blocks[std::min(first + i, count - 1)];
      xs[i] = block.x + half, ys[i] = block.y + half;
    }
    const Normalized middle = normalized(map, hn::Load(d, xs), hn::Load(d, ys));
    Parameters found[1];
    invert<1>(p, {middle.x}, {middle.y}, kReach, 1, found);
    const BlockBound bound = bound_blocks(p, opaque ? 3 : 4, sides, found[0].s, found[0].t);
    // Nodes may lie outside the square, where gradients are larger than those that Newton's method
    // was told.
    const Mask fits = hn::And(
        hn::And(found[0].found, bound.valid),
        hn::And(bound.gradient <= number(kSteeper * p.steepest), bound.error <= number(kAllowed)));
    hn::Store(hn::IfThenElseZero(fits, number(1)), d, ok);
    for (int i = 0; i < std::min(lanes, count - first); ++i) fit[first + i] = ok[i] != 0;
  }
}

template <int kSide>
bool find_series_of(const PatchProgram& p, const float (&map)[6], bool opaque,
                    const ColorBlock& block, float* series) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) float xs[16], ys[16];
  for (int i = 0; i < 16; ++i) {
    xs[i] = block.x + kChebyshev<kSide>.node[i % 4];
    ys[i] = block.y + kChebyshev<kSide>.node[i / 4];
  }
  for (int i = 0; i < 16; i += lanes) {
    const Normalized point = normalized(map, hn::Load(d, xs + i), hn::Load(d, ys + i));
    // Interpolation may add up the nodes' errors to 3.4 times the largest.
    Parameters at[1];
    invert<1>(p, {point.x}, {point.y}, kReach, 8 * kSteeper, at);
    if (!hn::AllTrue(d, at[0].found)) return false;
    for (int k = 0; k < (opaque ? 3 : 4); ++k) {
      hn::StoreU(bicubic(p.color[k], at[0].s, at[0].t), d, series + BlockPlan::kTerms * k + i);
    }
  }
  for (int k = 0; k < (opaque ? 3 : 4); ++k) make_series(series + BlockPlan::kTerms * k);
  return true;
}

bool find_series(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
                 const ColorBlock& block, float* series) {
  switch (side) {
    case 8:
      return find_series_of<8>(p, map, opaque, block, series);
    case 16:
      return find_series_of<16>(p, map, opaque, block, series);
    default:
      return find_series_of<32>(p, map, opaque, block, series);
  }
}

/// The polynomial at the samples from `first` on.
HWY_INLINE V interpolated(const float* series, int first) {
  const Floats d;
  V across[4], sum = hn::Zero(d);
  for (int i = 0; i < 4; ++i) across[i] = hn::Load(d, kBlockSamples.across[i] + first);
  for (int j = 0; j < 4; ++j) {
    V row = hn::Zero(d);
    for (int i = 0; i < 4; ++i) row = row + number(series[4 * j + i]) * across[i];
    sum = sum + row * hn::Load(d, kBlockSamples.down[j] + first);
  }
  return sum;
}

bool matches(const PatchProgram& p, const float (&map)[6], bool opaque, const ColorBlock& block,
             const float* series, std::uint64_t samples) {
  constexpr float kAllowed = 1.0f / 170 / 255;
  constexpr int kTogether = 2;
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V zero = hn::Zero(d), one = number(1);
  for (int first = 0; first < 64; first += kTogether * lanes) {
    V x[kTogether], y[kTogether];
    for (int k = 0; k < kTogether; ++k) {
      const V from_left = hn::Load(d, kBlockSamples.x + first + k * lanes);
      const V from_top = hn::Load(d, kBlockSamples.y + first + k * lanes);
      const Normalized at =
          normalized(map, number(block.x) + from_left, number(block.y) + from_top);
      x[k] = at.x, y[k] = at.y;
    }
    Parameters at[kTogether];
    invert<kTogether>(p, x, y, kMargin, 1, at);
    for (int k = 0; k < kTogether; ++k) {
      const int n = first + k * lanes;
      Mask good = at[k].found;
      for (int c = 0; c < (opaque ? 3 : 4); ++c) {
        const V here = interpolated(series + BlockPlan::kTerms * c, n);
        const V there = bicubic(p.color[c], at[k].s, at[k].t);
        const V off = hn::Min(hn::Max(here, zero), one) - hn::Min(hn::Max(there, zero), one);
        good = hn::And(good, hn::Abs(off) <= number(kAllowed));
      }
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, good, bits);
      std::uint64_t good_ones;
      std::memcpy(&good_ones, bits, sizeof bits);
      const std::uint64_t wanted = samples >> n & ((std::uint64_t{1} << lanes) - 1);
      if (wanted & ~good_ones) return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(judge);
HWY_EXPORT(find_series);
HWY_EXPORT(matches);
}  // namespace

void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, side, blocks, fit);
}

bool find_block_series(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                       const ColorBlock& block, float* series) {
  return HWY_DYNAMIC_DISPATCH(find_series)(program, map, opaque, side, block, series);
}

bool block_matches(const PatchProgram& program, const float (&map)[6], bool opaque,
                   const ColorBlock& block, const float* series, std::uint64_t samples) {
  return HWY_DYNAMIC_DISPATCH(matches)(program, map, opaque, block, series, samples);
}

}  // namespace quadrille
#endif
