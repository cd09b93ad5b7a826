#include "block_colors.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_colors.cpp"
#include <hwy/foreach_target.h>

#include "newton-inl.h"

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

/// Frobenius norms of the position's second, third and fourth derivatives at parameters; the fourth
/// are the same everywhere, and there are no higher ones.
struct Derivatives {
  V second, third, fourth;
};
HWY_INLINE Derivatives derivatives_at(const PatchProgram& p, const V& s, const V& t) {
  V second = hn::Zero(Floats()), third = second;
  float fourth = 0;
  for (const auto& q : p.position) {
    const V ss =
        number(2 * q[0]) + number(6 * q[1]) * s + (number(2 * q[3]) + number(6 * q[4]) * s) * t;
    const V tt =
        number(2 * q[5]) + number(2 * q[6]) * s + (number(6 * q[7]) + number(6 * q[8]) * s) * t;
    const V st = number(q[2]) + (number(2 * q[3]) + number(3 * q[4]) * s) * s +
                 (number(2 * q[6]) + number(3 * q[8]) * t) * t;
    second = second + (ss * ss + tt * tt + number(2) * st * st);
    const V sss = number(6 * q[1]) + number(6 * q[4]) * t;
    const V ttt = number(6 * q[7]) + number(6 * q[8]) * s;
    const V sst = number(2 * q[3]) + number(6 * q[4]) * s;
    const V stt = number(2 * q[6]) + number(6 * q[8]) * t;
    third = third + (sss * sss + ttt * ttt + number(3) * (sst * sst + stt * stt));
    fourth += 4 * 36 * (q[4] * q[4] + q[8] * q[8]);
  }
  return {hn::Sqrt(second), hn::Sqrt(third), number(std::sqrt(fourth))};
}

/// Coefficients of a cubic around x instead of 0.
HWY_INLINE void shift(V& c0, V& c1, V& c2, const V& c3, const V& x) {
  const V a = c3 * x, b = c2 + a;
  const V twice = b + c2;
  c0 = ((b * x) + c1) * x + c0;
  c1 = (twice + a + a) * x + c1;
  c2 = b + a + a;
}

/// Frobenius norms of the derivatives of orders 1 to 6 of the channels' colours at parameters, the
/// largest of the channels each; there are no higher ones.
struct ColorDerivatives {
  V order[7];
};
HWY_INLINE ColorDerivatives color_derivatives_at(const PatchProgram& p, int channels, const V& s,
                                                 const V& t) {
  // binomial(i + j, i) (i! j!)^2, [j][i].
  constexpr float kShare[4][4] = {
      {1, 1, 4, 36}, {1, 2, 12, 144}, {4, 12, 96, 1440}, {36, 144, 1440, 25920}};
  ColorDerivatives most;
  for (V& order : most.order) order = hn::Zero(Floats());
  for (int k = 0; k < channels; ++k) {
    V a[4][4];
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) a[j][i] = number(p.color[k][4 * j + i]);
      shift(a[j][0], a[j][1], a[j][2], a[j][3], s);
    }
    for (int i = 0; i < 4; ++i) shift(a[0][i], a[1][i], a[2][i], a[3][i], t);
    V squares[7];
    for (V& square : squares) square = hn::Zero(Floats());
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        squares[i + j] = squares[i + j] + number(kShare[j][i]) * (a[j][i] * a[j][i]);
      }
    }
    for (int n = 1; n < 7; ++n) most.order[n] = hn::Max(most.order[n], squares[n]);
  }
  for (int n = 1; n < 7; ++n) most.order[n] = hn::Sqrt(most.order[n]);
  return most;
}

/// Bounds of the orders 1 to 4 as far as `reach` from there, by Taylor's formula.
HWY_INLINE void widen(ColorDerivatives& c, const V& reach) {
  for (int n = 1; n <= 4; ++n) {
    V sum = c.order[6];
    for (int k = 5; k >= n; --k) {
      sum = c.order[k] + sum * reach * number(1.0f / static_cast<float>(k + 1 - n));
    }
    c.order[n] = sum;
  }
}

/// Bounds of the derivatives of orders 1 to 4 of the inverse in a disc of radius r around points
/// whose Jacobian's inverse is of norm b. At distance d from their parameters |J^-1| is at most
/// b / (1 - b |Q''| d), so a way of length x in the disc leads no farther than d with
/// d - b |Q''| d^2 / 2 = b x, and the disc's image stays within
/// `reach` = (1 - (1 - 2 b^2 |Q''| r)^(1/2)) / (b |Q''|). |Q''| is bounded as far as 3/2 b r, which
/// reach must not exceed.
struct InverseBound {
  V order[5], reach;
  Mask valid;
};
HWY_INLINE InverseBound bound_inverse(const Derivatives& q, const V& b, float r) {
  const V one = number(1), half = number(0.5f);
  const V straight = b * number(r), most = number(1.5f) * straight;
  const auto second_within = [&](const V& d) {
    return q.second + d * (q.third + half * d * q.fourth);
  };
  const V root =
      hn::Sqrt(hn::Max(one - number(2) * b * second_within(most) * straight, hn::Zero(Floats())));
  // (1 - root) / (b |Q''|) without cancellation.
  const V reach = number(2) * straight / (one + root);
  const V third = q.third + reach * q.fourth, second = second_within(reach);
  const V m = b / root, m2 = m * m;
  // Faa di Bruno: the terms of the derivatives of an inverse, all of one sign.
  const V bend = m * second;
  return {{one, m, m2 * bend, m2 * m2 * (third + number(3) * (bend * second)),
           m2 * m2 * m * (q.fourth + bend * (number(10) * third + number(15) * (bend * second)))},
          reach,
          root >= number(1.0f / 3)};
}

/// A bound of the fourth derivatives of the colours as functions of the point: Faa di Bruno's
/// formula again.
HWY_INLINE V fourth_derivatives(const ColorDerivatives& color, const InverseBound& inverse) {
  const V *c = color.order, *f = inverse.order;
  const V slope2 = f[1] * f[1];
  return (c[1] * f[4] + c[2] * (number(4) * (f[1] * f[3]) + number(3) * (f[2] * f[2]))) +
         (number(6) * (c[3] * (slope2 * f[2])) + c[4] * (slope2 * slope2));
}

void judge(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
           std::span<const ColorBlock> blocks, bool* fit) {
  const Floats d;
  constexpr float kAllowed = 1.0f / 130 / 255;
  const float half = static_cast<float>(side) / 2, quarter = half / 2;
  const float across[2] = {map[0] + map[1], map[3] + map[4]};
  const float along[2] = {map[0] - map[1], map[3] - map[4]};
  const float radius = half * std::sqrt(std::max(across[0] * across[0] + across[1] * across[1],
                                                 along[0] * along[0] + along[1] * along[1]));
  // Interpolation in x, then in y, of which the first's error grows by Lebesgue's constant 1.85:
  // max |(x - x_1) ... (x - x_4)| / 4! = (side / 4)^4 / 12 times the fourth derivative.
  const float wx = map[0] * map[0] + map[3] * map[3], wy = map[1] * map[1] + map[4] * map[4];
  const float factor =
      quarter * quarter * quarter * quarter / 12 * (1.85f * (wx * wx) + wy * wy) / kAllowed;
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
    const Parameters& at = found[0];
    const NewtonStep jacobian = newton_step(p, middle.x, middle.y, at.s, at.t, 1);
    const V f = jacobian.frobenius, det = jacobian.determinant, twice = number(2) * det;
    // The larger singular value of the inverse.
    const V spread = hn::Sqrt(hn::Max(f * f - twice * twice, hn::Zero(d)));
    const V b = hn::Sqrt((f + spread) * number(0.5f)) / det;
    const InverseBound bound = bound_inverse(derivatives_at(p, at.s, at.t), b, radius);
    ColorDerivatives color = color_derivatives_at(p, opaque ? 3 : 4, at.s, at.t);
    widen(color, bound.reach);
    // Nodes may lie outside the square, where gradients are larger than those that Newton's method
    // was told.
    const Mask tame = color.order[1] <= number(kSteeper * p.steepest);
    const Mask fits =
        hn::And(hn::And(at.found, bound.valid),
                hn::And(tame, fourth_derivatives(color, bound) * number(factor) <= number(1)));
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
    const int begin = std::max(span.x_begin - target.left, 0);
    const int end = std::min(span.x_end - target.left, kSide);
    const int y = span.y - target.top;
    const std::ptrdiff_t row = span.y * target.samples.stride + target.left;
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
                  std::span<const ColorBlock> blocks, bool* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, side, blocks, fit);
}

bool paint_block(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                 const ColorBlock& block, const BlockTarget& target) {
  return HWY_DYNAMIC_DISPATCH(paint)(program, map, opaque, side, block, target);
}

}  // namespace quadrille
#endif
