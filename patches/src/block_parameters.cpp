#include "block_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_parameters.cpp"
#include <hwy/foreach_target.h>

#include "newton-inl.h"

#ifndef QUADRILLE_BLOCK_PARAMETERS_ONCE
#define QUADRILLE_BLOCK_PARAMETERS_ONCE

namespace quadrille {

/// Four Chebyshev nodes on a side of a block, and how much each weighs at the samples' centres.
struct NodeWeights {
  static constexpr int kSide = kParameterBlock;
  float node[4];
  /// Padded, so that vectors may begin at any sample.
  alignas(64) float weight[4][2 * kSide];

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
inline constexpr NodeWeights kNodes;

}  // namespace quadrille

#endif

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

/// How far outside the square nodes and middles of blocks may lie.
constexpr float kReach = 0.5f;

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

/// The largest gradient of the channels at parameters.
HWY_INLINE V gradient_at(const PatchProgram& p, int channels, const V& s, const V& t) {
  V most = hn::Zero(Floats());
  for (int k = 0; k < channels; ++k) {
    V row[4], slope[4];
    for (int j = 0; j < 4; ++j) {
      const float* const c = p.color[k] + 4 * j;
      const V b2 = number(c[3]) * s + number(c[2]), b1 = b2 * s + number(c[1]);
      row[j] = b1 * s + number(c[0]);
      slope[j] = (number(c[3]) * s + b2) * s + b1;
    }
    const V along_s = ((slope[3] * t + slope[2]) * t + slope[1]) * t + slope[0];
    const V along_t = (number(3) * row[3] * t + number(2) * row[2]) * t + row[1];
    most = hn::Max(most, along_s * along_s + along_t * along_t);
  }
  return hn::Sqrt(most);
}

/// A bound of the fourth derivatives of the inverse in a disc of radius r around points whose
/// Jacobian's inverse is of norm b. With a majorant's help |J^-1| <= m = b / (1 - e) as far as
/// `reach` = 3/2 b r from their parameters, where e = b |Q''| reach is at most 1/3, so that the
/// disc's image stays within reach.
struct InverseBound {
  V fourth, reach;
  Mask valid;
};
HWY_INLINE InverseBound bound_inverse(const Derivatives& q, const V& b, float r) {
  const V one = number(1), reach = number(1.5f * r) * b;
  const V third = q.third + reach * q.fourth;
  const V second = q.second + reach * (q.third + number(0.5f) * reach * q.fourth);
  const V e = b * second * reach;
  const V m = b / (one - hn::Min(e, number(0.5f))), m2 = m * m;
  // Faa di Bruno: the terms of the fourth derivative of an inverse, all of one sign.
  const V fourth =
      m2 * m2 * m *
      (q.fourth + m * second * (number(10) * third + number(15) * m * second * second));
  return {fourth, reach, e <= number(1.0f / 3)};
}

void judge(const PatchProgram& p, const float (&map)[6], bool opaque, const ParameterBlock* blocks,
           int count, bool* fit) {
  const Floats d;
  constexpr float kHalf = kParameterBlock / 2.0f, kAllowed = 1.0f / 200 / 255;
  const float across[2] = {map[0] + map[1], map[3] + map[4]};
  const float along[2] = {map[0] - map[1], map[3] - map[4]};
  const float radius = kHalf * std::sqrt(std::max(across[0] * across[0] + across[1] * across[1],
                                                  along[0] * along[0] + along[1] * along[1]));
  // Interpolation in x, then in y, of which the first's error grows by Lebesgue's constant 1.85:
  // max |(x - x_1) ... (x - x_4)| / 4! = (side / 4)^4 / 12 times the fourth derivative.
  const float wx = map[0] * map[0] + map[3] * map[3], wy = map[1] * map[1] + map[4] * map[4];
  constexpr float kQuarter = kParameterBlock / 4.0f;
  const float factor =
      kQuarter * kQuarter * kQuarter * kQuarter / 12 * 1.85f * (wx * wx + wy * wy) / kAllowed;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int first = 0; first < count; first += lanes) {
    alignas(64) float xs[16], ys[16], ok[16];
    for (int i = 0; i < lanes; ++i) {
      const ParameterBlock& block = blocks[std::min(first + i, count - 1)];
      xs[i] = block.x + kHalf, ys[i] = block.y + kHalf;
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
    const V gradient = hn::Min(number(p.steepest), gradient_at(p, opaque ? 3 : 4, at.s, at.t) +
                                                       bound.reach * number(p.color_curvature));
    const Mask fits = hn::And(hn::And(at.found, bound.valid),
                              bound.fourth * (gradient * number(factor)) <= number(1));
    hn::Store(hn::IfThenElseZero(fits, number(1)), d, ok);
    for (int i = 0; i < std::min(lanes, count - first); ++i) fit[first + i] = ok[i] != 0;
  }
}

/// Parameters at the nodes: [4 row + column].
HWY_INLINE bool find_nodes(const PatchProgram& p, const float (&map)[6],
                           const ParameterBlock& block, float (&s)[16], float (&t)[16]) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) float xs[16], ys[16];
  for (int i = 0; i < 16; ++i) {
    xs[i] = block.x + kNodes.node[i % 4];
    ys[i] = block.y + kNodes.node[i / 4];
  }
  Mask found = hn::FirstN(d, 16);
  for (int i = 0; i < 16; i += lanes) {
    const Normalized point = normalized(map, hn::Load(d, xs + i), hn::Load(d, ys + i));
    // Interpolation may add up the nodes' errors to 3.4 times the largest.
    Parameters at[1];
    invert<1>(p, {point.x}, {point.y}, kReach, 4, at);
    found = hn::And(found, at[0].found);
    hn::Store(at[0].s, d, s + i);
    hn::Store(at[0].t, d, t + i);
  }
  return hn::AllTrue(d, found);
}

/// Interpolates the nodes' values in y: columns[i][y].
HWY_INLINE void interpolate_columns(const float (&nodes)[16], float (&columns)[4][16]) {
  const Floats d;
  for (int y = 0; y < kParameterBlock; y += static_cast<int>(hn::Lanes(d))) {
    for (int i = 0; i < 4; ++i) {
      V sum = number(nodes[i]) * hn::Load(d, kNodes.weight[0] + y);
      for (int j = 1; j < 4; ++j) {
        sum = sum + number(nodes[4 * j + i]) * hn::Load(d, kNodes.weight[j] + y);
      }
      hn::Store(sum, d, columns[i] + y);
    }
  }
}

bool add(const PatchProgram& p, const float (&map)[6], const ParameterBlock& block,
         const BlockRow* rows, int row_count, ColorBatch& batch) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) float s[16], t[16], columns_s[4][16], columns_t[4][16];
  if (!find_nodes(p, map, block, s, t)) return false;
  interpolate_columns(s, columns_s);
  interpolate_columns(t, columns_t);
  for (int r = 0; r < row_count; ++r) {
    const BlockRow& row = rows[r];
    const auto value = [&](const float(&columns)[4][16], int x) {
      V sum = number(columns[0][row.y]) * hn::LoadU(d, kNodes.weight[0] + x);
      for (int i = 1; i < 4; ++i) {
        sum = sum + number(columns[i][row.y]) * hn::LoadU(d, kNodes.weight[i] + x);
      }
      return sum;
    };
    // In whole vectors: what is too much is written over.
    for (int i = 0; i < row.count; i += lanes) {
      hn::StoreU(value(columns_s, row.x + i), d, batch.s + batch.count + i);
      hn::StoreU(value(columns_t, row.x + i), d, batch.t + batch.count + i);
    }
    batch.count += row.count;
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
HWY_EXPORT(add);
}  // namespace

void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque,
                  const ParameterBlock* blocks, int count, bool* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, blocks, count, fit);
}

bool add_block(const PatchProgram& program, const float (&map)[6], const ParameterBlock& block,
               const BlockRow* rows, int row_count, ColorBatch& batch) {
  return HWY_DYNAMIC_DISPATCH(add)(program, map, block, rows, row_count, batch);
}

}  // namespace quadrille
#endif
