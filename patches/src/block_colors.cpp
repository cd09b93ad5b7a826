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

template <int kSide>
bool find_nodes_of(const PatchProgram& p, const float (&map)[6], bool opaque,
                   const ColorBlock& block, BlockNodes& nodes) {
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
    for (int k = 0; k < (opaque ? 3 : 4); ++k) {
      hn::StoreU(bicubic(p.color[k], at[0].s, at[0].t), d, nodes[k] + i);
    }
  }
  return true;
}

bool find_nodes(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
                const ColorBlock& block, BlockNodes& nodes) {
  switch (side) {
    case 8:
      return find_nodes_of<8>(p, map, opaque, block, nodes);
    case 16:
      return find_nodes_of<16>(p, map, opaque, block, nodes);
    default:
      return find_nodes_of<32>(p, map, opaque, block, nodes);
  }
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

/// Paints the columns [begin, end) of one row of a block, of which `out` is the first sample.
template <int kSide, bool opaque>
HWY_INLINE void paint_row(const float (&columns)[opaque ? 3 : 4][4][kSide], int y, int begin,
                          int end, float* const (&out)[4], bool has_alpha) {
  const hn::CappedTag<float, std::min(kSide, 16)> d;
  using Vector = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto& weight = kNodes<kSide>.weight;
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const auto paint_vector = [&](int x, const auto& store) {
    const Vector w[4] = {hn::Load(d, weight[0] + x), hn::Load(d, weight[1] + x),
                         hn::Load(d, weight[2] + x), hn::Load(d, weight[3] + x)};
    const auto color = [&](int k) {
      Vector sum = hn::Set(d, columns[k][0][y]) * w[0];
      for (int i = 1; i < 4; ++i) sum = sum + hn::Set(d, columns[k][i][y]) * w[i];
      return sum;
    };
    Vector alpha = one;
    if constexpr (!opaque) alpha = hn::Min(hn::Max(color(3), zero), one);
    const Vector c[3] = {color(0), color(1), color(2)};
    for (int k = 0; k < 3; ++k) store(hn::Min(hn::Max(c[k], zero), alpha), out[k] + x);
    if (!opaque || has_alpha) store(alpha, out[3] + x);
  };
  if (begin == 0 && end == kSide) {
    for (int x = 0; x < kSide; x += lanes) {
      paint_vector(x, [&](const Vector& v, float* to) { hn::StoreU(v, d, to); });
    }
    return;
  }
  const Vector counted = hn::Iota(d, 0);
  for (int x = begin & -lanes; x < end; x += lanes) {
    const auto inside = hn::And(counted >= hn::Set(d, static_cast<float>(begin - x)),
                                counted < hn::Set(d, static_cast<float>(end - x)));
    paint_vector(x, [&](const Vector& v, float* to) { hn::BlendedStore(v, inside, d, to); });
  }
}

template <int kSide, bool opaque>
void paint_of(const BlockNodes& nodes, const BlockTarget& target) {
  constexpr int kChannels = opaque ? 3 : 4;
  alignas(64) float columns[kChannels][4][kSide];
  for (int k = 0; k < kChannels; ++k) interpolate_columns<kSide>(nodes[k], columns[k]);
  const SampleWindow& window = target.window;
  const SamplePlanes& samples = target.samples;
  for (const SampleSpan& span : target.spans) {
    if (span.y < window.y_begin || span.y >= window.y_end) continue;
    const int begin = std::max({span.x_begin, window.x_begin, target.left}) - target.left;
    const int end = std::min({span.x_end, window.x_end, target.left + kSide}) - target.left;
    if (begin >= end) continue;
    const std::ptrdiff_t row =
        (span.y - window.y_begin) * samples.stride + (target.left - window.x_begin);
    paint_row<kSide, opaque>(columns, span.y - target.top, begin, end,
                             {samples.channel[0] + row, samples.channel[1] + row,
                              samples.channel[2] + row, samples.channel[3] + row},
                             samples.has_alpha);
  }
}

void paint(const BlockNodes& nodes, bool opaque, int side, const BlockTarget& target) {
  switch (side) {
    case 8:
      return (opaque ? paint_of<8, true> : paint_of<8, false>)(nodes, target);
    case 16:
      return (opaque ? paint_of<16, true> : paint_of<16, false>)(nodes, target);
    default:
      return (opaque ? paint_of<32, true> : paint_of<32, false>)(nodes, target);
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
HWY_EXPORT(find_nodes);
HWY_EXPORT(paint);
}  // namespace

void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, side, blocks, fit);
}

bool find_block_nodes(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                      const ColorBlock& block, BlockNodes& nodes) {
  return HWY_DYNAMIC_DISPATCH(find_nodes)(program, map, opaque, side, block, nodes);
}

void paint_block(const BlockNodes& nodes, bool opaque, int side, const BlockTarget& target) {
  HWY_DYNAMIC_DISPATCH(paint)(nodes, opaque, side, target);
}

}  // namespace quadrille
#endif
