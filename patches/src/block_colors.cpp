#include "block_colors.h"

#include <algorithm>

#include "node_weights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_colors.cpp"
#include <hwy/foreach_target.h>

#include "block_bound-inl.h"

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
                   const ColorBlock& block, float* nodes) {
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
      hn::StoreU(bicubic(p.color[k], at[0].s, at[0].t), d, nodes + BlockPlan::kNodes * k + i);
    }
  }
  return true;
}

bool find_nodes(const PatchProgram& p, const float (&map)[6], bool opaque, int side,
                const ColorBlock& block, float* nodes) {
  switch (side) {
    case 8:
      return find_nodes_of<8>(p, map, opaque, block, nodes);
    case 16:
      return find_nodes_of<16>(p, map, opaque, block, nodes);
    default:
      return find_nodes_of<32>(p, map, opaque, block, nodes);
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
}  // namespace

void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit) {
  HWY_DYNAMIC_DISPATCH(judge)(program, map, opaque, side, blocks, fit);
}

bool find_block_nodes(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                      const ColorBlock& block, float* nodes) {
  return HWY_DYNAMIC_DISPATCH(find_nodes)(program, map, opaque, side, block, nodes);
}

}  // namespace quadrille
#endif
