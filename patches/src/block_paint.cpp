#include "block_paint.h"

#include <algorithm>
#include <cstring>

#include "node_weights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_paint.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pixel_words-inl.h"

#ifndef QUADRILLE_BLOCK_PAINT_ONCE
#define QUADRILLE_BLOCK_PAINT_ONCE

namespace quadrille {

/// The weights of two rows of a block side by side: [y / 2][node][8 (y % 2) + x].
struct RowPairWeights {
  alignas(64) float weight[4][4][16];

  constexpr RowPairWeights() : weight() {
    for (int y = 0; y < 8; ++y) {
      for (int i = 0; i < 4; ++i) {
        for (int x = 0; x < 8; ++x) weight[y / 2][i][8 * (y % 2) + x] = kNodes<8>.weight[i][y];
      }
    }
  }
};
inline constexpr RowPairWeights kRowPairs;

/// The samples of a block of which the part in the window is painted: a bit for each column of each
/// row. `first` is the block's first sample relative to the window's.
struct PaintedBlock {
  bool full;
  std::ptrdiff_t first;
  std::uint32_t rows[kBlockSides[0]];
};

}  // namespace quadrille

#endif

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The lowest of the bits as a mask.
template <class D>
HWY_INLINE auto mask_of(D d, std::uint32_t bits) {
  std::uint8_t bytes[8];
  const std::uint64_t wide = bits;
  std::memcpy(bytes, &wide, sizeof bytes);
  return hn::LoadMaskBits(d, bytes);
}

/// Where samples go that are stored as floats.
struct FloatTarget {
  const SamplePlanes& planes;

  std::ptrdiff_t stride() const { return planes.stride; }
  template <class D, class V>
  HWY_INLINE void store(D d, const V (&c)[4], std::ptrdiff_t at) const {
    each_channel([&](int k) { hn::StoreU(c[k], d, planes.channel[k] + at); });
  }
  template <class D, class V>
  HWY_INLINE void store_some(D d, const V (&c)[4], std::ptrdiff_t at, std::uint32_t bits) const {
    const auto mask = mask_of(d, bits);
    each_channel([&](int k) { hn::BlendedStore(c[k], mask, d, planes.channel[k] + at); });
  }
#if HWY_CAP_GE512
  /// The two halves of vectors go to consecutive rows.
  template <class D, class V>
  HWY_INLINE void store_pair(D, const V (&c)[4], std::ptrdiff_t at) const {
    const hn::Half<D> half;
    each_channel([&](int k) {
      hn::StoreU(hn::LowerHalf(half, c[k]), half, planes.channel[k] + at);
      hn::StoreU(hn::UpperHalf(half, c[k]), half, planes.channel[k] + at + stride());
    });
  }
  template <class D, class V>
  HWY_INLINE void store_some_pair(D, const V (&c)[4], std::ptrdiff_t at,
                                  const std::uint32_t* bits) const {
    const hn::Half<D> half;
    const auto upper = mask_of(half, bits[0]), lower = mask_of(half, bits[1]);
    each_channel([&](int k) {
      hn::BlendedStore(hn::LowerHalf(half, c[k]), upper, half, planes.channel[k] + at);
      hn::BlendedStore(hn::UpperHalf(half, c[k]), lower, half, planes.channel[k] + at + stride());
    });
  }
#endif

 private:
  template <class Body>
  HWY_INLINE void each_channel(const Body& body) const {
    for (int k = 0; k < 3; ++k) body(k);
    if (planes.has_alpha) body(3);
  }
};

/// Where samples go that are stored as opaque 8-bit pixels.
struct WordTarget {
  const PixelWords& pixels;

  std::ptrdiff_t stride() const { return pixels.stride; }
  template <class D, class V>
  HWY_INLINE void store(D d, const V (&c)[4], std::ptrdiff_t at) const {
    hn::StoreU(opaque_words(d, c[0], c[1], c[2]), hn::RebindToUnsigned<D>(), pixels.first + at);
  }
  template <class D, class V>
  HWY_INLINE void store_some(D d, const V (&c)[4], std::ptrdiff_t at, std::uint32_t bits) const {
    const hn::RebindToUnsigned<D> du;
    hn::BlendedStore(opaque_words(d, c[0], c[1], c[2]), mask_of(du, bits), du, pixels.first + at);
  }
#if HWY_CAP_GE512
  template <class D, class V>
  HWY_INLINE void store_pair(D d, const V (&c)[4], std::ptrdiff_t at) const {
    const hn::Half<hn::RebindToUnsigned<D>> half;
    const auto words = opaque_words(d, c[0], c[1], c[2]);
    hn::StoreU(hn::LowerHalf(half, words), half, pixels.first + at);
    hn::StoreU(hn::UpperHalf(half, words), half, pixels.first + at + stride());
  }
  template <class D, class V>
  HWY_INLINE void store_some_pair(D d, const V (&c)[4], std::ptrdiff_t at,
                                  const std::uint32_t* bits) const {
    const hn::Half<hn::RebindToUnsigned<D>> half;
    const auto words = opaque_words(d, c[0], c[1], c[2]);
    hn::BlendedStore(hn::LowerHalf(half, words), mask_of(half, bits[0]), half, pixels.first + at);
    hn::BlendedStore(hn::UpperHalf(half, words), mask_of(half, bits[1]), half,
                     pixels.first + at + stride());
  }
#endif
};

/// Values of the channels' polynomials along a row or two, from those at the nodes' rows.
template <bool opaque, class D, class V, class Weight>
HWY_INLINE void colors_at(D d, const V (&across)[opaque ? 3 : 4][4], const Weight& weight,
                          V (&c)[4]) {
  const V zero = hn::Zero(d);
  const V w[4] = {weight(0), weight(1), weight(2), weight(3)};
  c[3] = hn::Set(d, 1.0f);
  for (int k = opaque ? 2 : 3; k >= 0; --k) {
    const V* const a = across[k];
    const V value = (a[0] * w[0] + a[1] * w[1]) + (a[2] * w[2] + a[3] * w[3]);
    c[k] = hn::Min(hn::Max(value, zero), c[3]);
  }
}

/// Values along the nodes' rows: [channel][row].
template <bool opaque, class D, class V>
HWY_INLINE void values_across(D d, const float* nodes, const V (&w)[4],
                              V (&across)[opaque ? 3 : 4][4]) {
  for (int k = 0; k < (opaque ? 3 : 4); ++k) {
    for (int j = 0; j < 4; ++j) {
      const float* const n = nodes + BlockPlan::kNodes * k + 4 * j;
      across[k][j] = (hn::Set(d, n[0]) * w[0] + hn::Set(d, n[1]) * w[1]) +
                     (hn::Set(d, n[2]) * w[2] + hn::Set(d, n[3]) * w[3]);
    }
  }
}

#if HWY_CAP_GE512
/// Two rows of a block of eight at a time.
template <bool opaque, class Target>
HWY_INLINE void paint_pairs(const float* nodes, const PaintedBlock& block, const Target& target) {
  const hn::CappedTag<float, 16> d;
  const hn::Half<decltype(d)> half;
  using V = hn::Vec<decltype(d)>;
  using Row = hn::Vec<decltype(half)>;
  const Row w[4] = {hn::Load(half, kNodes<8>.weight[0]), hn::Load(half, kNodes<8>.weight[1]),
                    hn::Load(half, kNodes<8>.weight[2]), hn::Load(half, kNodes<8>.weight[3])};
  V twice[4], across[opaque ? 3 : 4][4];
  for (int i = 0; i < 4; ++i) twice[i] = hn::Combine(d, w[i], w[i]);
  values_across<opaque>(d, nodes, twice, across);
  for (int y = 0; y < 8; y += 2) {
    if (!block.full && (block.rows[y] | block.rows[y + 1]) == 0) continue;
    V c[4];
    colors_at<opaque>(
        d, across, [&](int i) { return hn::Load(d, kRowPairs.weight[y / 2][i]); }, c);
    const std::ptrdiff_t at = block.first + y * target.stride();
    if (block.full) {
      target.store_pair(d, c, at);
    } else {
      target.store_some_pair(d, c, at, block.rows + y);
    }
  }
}
#endif

template <int kSide, bool opaque, class Target>
HWY_INLINE void paint_rows(const float* nodes, const PaintedBlock& block, const Target& target) {
  const hn::CappedTag<float, std::min(kSide, 16)> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto& weight = kNodes<kSide>.weight;
  for (int x = 0; x < kSide; x += lanes) {
    const V w[4] = {hn::Load(d, weight[0] + x), hn::Load(d, weight[1] + x),
                    hn::Load(d, weight[2] + x), hn::Load(d, weight[3] + x)};
    V across[opaque ? 3 : 4][4];
    values_across<opaque>(d, nodes, w, across);
    const std::uint32_t all = (1u << lanes) - 1;
    for (int y = 0; y < kSide; ++y) {
      const std::uint32_t bits = block.full ? all : block.rows[y] >> x & all;
      if (bits == 0) continue;
      V c[4];
      colors_at<opaque>(
          d, across, [&](int i) { return hn::Set(d, weight[i][y]); }, c);
      const std::ptrdiff_t at = block.first + y * target.stride() + x;
      if (bits == all) {
        target.store(d, c, at);
      } else {
        target.store_some(d, c, at, bits);
      }
    }
  }
}

/// False where no sample of the block is painted.
HWY_INLINE bool clip(const BlockPlan& plan, const BlockPlan::Block& b, const SampleWindow& window,
                     std::ptrdiff_t stride, PaintedBlock& painted) {
  const int left = b.x - window.x_begin, top = b.y - window.y_begin;
  const int begin = std::max(-left, 0), end = std::min(window.x_end - b.x, b.side);
  const int first = std::max(-top, 0), last = std::min(window.y_end - b.y, b.side);
  if (begin >= end || first >= last) return false;
  painted.first = top * stride + left;
  const bool whole = end - begin == b.side && last - first == b.side;
  painted.full = b.full && whole;
  if (painted.full) return true;
  const auto before = [](int x) { return static_cast<std::uint32_t>((std::uint64_t{1} << x) - 1); };
  const std::uint32_t columns = before(end) & ~before(begin);
  const std::uint32_t* const rows = plan.rows.data() + b.coverage;
  for (int y = 0; y < b.side; ++y) {
    painted.rows[y] = y < first || y >= last ? 0 : b.full ? columns : rows[y] & columns;
  }
  return true;
}

template <bool opaque, class Target>
HWY_INLINE void paint_all(const BlockPlan& plan, const SampleWindow& window, const Target& target) {
  PaintedBlock painted;
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) {
    const BlockPlan::Block& block = plan.blocks[i];
    if (!clip(plan, block, window, target.stride(), painted)) continue;
    const float* const nodes = plan.nodes.data() + BlockPlan::kNodes * (opaque ? 3 : 4) * i;
    switch (block.side) {
      case 8:
#if HWY_CAP_GE512
        paint_pairs<opaque>(nodes, painted, target);
#else
        paint_rows<8, opaque>(nodes, painted, target);
#endif
        break;
      case 16:
        paint_rows<16, opaque>(nodes, painted, target);
        break;
      default:
        paint_rows<32, opaque>(nodes, painted, target);
    }
  }
}

void paint_floats(const BlockPlan& plan, bool opaque, const SampleWindow& window,
                  const SamplePlanes& samples) {
  const FloatTarget target = {samples};
  if (opaque) {
    paint_all<true>(plan, window, target);
  } else {
    paint_all<false>(plan, window, target);
  }
}

void paint_words(const BlockPlan& plan, const SampleWindow& window, const PixelWords& pixels) {
  paint_all<true>(plan, window, WordTarget{pixels});
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(paint_floats);
HWY_EXPORT(paint_words);
}  // namespace

void paint_blocks(const BlockPlan& plan, bool opaque, const SampleWindow& window,
                  const SamplePlanes& samples) {
  HWY_DYNAMIC_DISPATCH(paint_floats)(plan, opaque, window, samples);
}

void paint_blocks(const BlockPlan& plan, const SampleWindow& window, const PixelWords& pixels) {
  HWY_DYNAMIC_DISPATCH(paint_words)(plan, window, pixels);
}

}  // namespace quadrille
#endif
