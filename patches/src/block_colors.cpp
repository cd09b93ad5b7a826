#include "block_colors.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_colors.cpp"
#include <hwy/foreach_target.h>

#include "block_bound-inl.h"

#ifndef QUADRILLE_BLOCK_COLORS_ONCE
#define QUADRILLE_BLOCK_COLORS_ONCE

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

/// Colours at the nodes before clamping: [channel][4 row + column].
template <int kSide>
HWY_INLINE bool find_nodes(const PatchProgram& p, const float (&map)[6], const ColorBlock& block,
                           int channels, float (&colors)[4][16]) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) float xs[16], ys[16];
  for (int i = 0; i < 16; ++i) {
    xs[i] = block.x + kNodes<kSide>.node[i % 4];
    ys[i] = block.y + kNodes<kSide>.node[i / 4];
  }
  for (int i = 0; i < 16; i += lanes) {
    const Normalized point = normalized(map, hn::Load(d, xs + i), hn::Load(d, ys + i));
    // Interpolation may add up the nodes' errors to 3.4 times the largest.
    Parameters at[1];
    invert<1>(p, {point.x}, {point.y}, kReach, 8 * kSteeper, at);
    if (!hn::AllTrue(d, at[0].found)) return false;
    for (int k = 0; k < channels; ++k) {
      hn::Store(bicubic(p.color[k], at[0].s, at[0].t), d, colors[k] + i);
    }
  }
  return true;
}

/// Interpolates the nodes' values in y: columns[i][y].
template <int kSide>
HWY_INLINE void interpolate_columns(const float (&nodes)[16], float (&columns)[4][kSide]) {
  const hn::CappedTag<float, std::min(kSide, 16)> d;
  const auto& weight = kNodes<kSide>.weight;
  for (int y = 0; y < kSide; y += static_cast<int>(hn::Lanes(d))) {
    for (int i = 0; i < 4; ++i) {
      auto sum = hn::Set(d, nodes[i]) * hn::Load(d, weight[0] + y);
      for (int j = 1; j < 4; ++j) {
        sum = sum + hn::Set(d, nodes[4 * j + i]) * hn::Load(d, weight[j] + y);
      }
      hn::Store(sum, d, columns[i] + y);
    }
  }
}

template <int kSide, bool opaque>
bool paint_of(const PatchProgram& p, const float (&map)[6], const ColorBlock& block,
              const BlockTarget& target) {
  constexpr int kChannels = opaque ? 3 : 4;
  const hn::CappedTag<float, std::min(kSide, 16)> d;
  using Vector = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto& weight = kNodes<kSide>.weight;
  alignas(64) float nodes[4][16], columns[kChannels][4][kSide];
  if (!find_nodes<kSide>(p, map, block, kChannels, nodes)) return false;
  for (int k = 0; k < kChannels; ++k) interpolate_columns<kSide>(nodes[k], columns[k]);
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0f), counted = hn::Iota(d, 0);
  for (const SampleSpan& span : target.spans) {
    if (span.y < target.window.y_begin || span.y >= target.window.y_end) continue;
    const int begin = std::max({span.x_begin, target.window.x_begin, target.left}) - target.left;
    const int end = std::min({span.x_end, target.window.x_end, target.left + kSide}) - target.left;
    const int y = span.y - target.top;
    const std::ptrdiff_t row = (span.y - target.window.y_begin) * target.samples.stride +
                               (target.left - target.window.x_begin);
    for (int x = begin & -lanes; x < end; x += lanes) {
      const auto color = [&](int k) {
        Vector sum = hn::Set(d, columns[k][0][y]) * hn::Load(d, weight[0] + x);
        for (int i = 1; i < 4; ++i) {
          sum = sum + hn::Set(d, columns[k][i][y]) * hn::Load(d, weight[i] + x);
        }
        return sum;
      };
      const bool whole = x >= begin && x + lanes <= end;
      const auto inside = hn::And(counted >= hn::Set(d, static_cast<float>(begin - x)),
                                  counted < hn::Set(d, static_cast<float>(end - x)));
      const auto store = [&](const Vector& v, int k) {
        float* const out = target.samples.channel[k] + row + x;
        if (whole) {
          hn::StoreU(v, d, out);
        } else {
          hn::BlendedStore(v, inside, d, out);
        }
      };
      Vector alpha = one;
      if constexpr (!opaque) alpha = hn::Min(hn::Max(color(3), zero), one);
      if (!opaque || target.samples.has_alpha) store(alpha, 3);
      for (int k = 0; k < 3; ++k) store(hn::Min(hn::Max(color(k), zero), alpha), k);
    }
  }
  return true;
}

bool paint(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
           const ColorBlock& block, const BlockTarget& target) {
  switch (side) {
    case 8:
      return (opaque ? paint_of<8, true> : paint_of<8, false>)(p, map, block, target);
    case 16:
      return (opaque ? paint_of<16, true> : paint_of<16, false>)(p, map, block, target);
    default:
      return (opaque ? paint_of<32, true> : paint_of<32, false>)(p, map, block, target);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(judge);
HWY_EXPORT(paint);
}  // namespace

void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, side, blocks, fit);
}

bool paint_block(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                 const ColorBlock& block, const BlockTarget& target) {
  return HWY_DYNAMIC_DISPATCH(paint)(program, map, opaque, side, block, target);
}

}  // namespace quadrille
#endif
