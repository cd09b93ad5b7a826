#include "block_paint.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "bit_range.h"
#include "chebyshev_basis.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "block_paint.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pixel_words-inl.h"

#ifndef QUADRILLE_BLOCK_PAINT_ONCE
#define QUADRILLE_BLOCK_PAINT_ONCE

namespace quadrille {

/// The basis at two rows of a block side by side: [y / 2][polynomial][8 (y % 2) + x]. T_0 is
/// nowhere multiplied by, so that nobody loads it.
struct RowPairBasis {
  alignas(64) float t[2][4][16];

  constexpr RowPairBasis() : t() {
    for (int y = 0; y < 4; ++y) {
      for (int i = 0; i < 4; ++i) {
        for (int x = 0; x < 8; ++x) t[y / 2][i][8 * (y % 2) + x] = kChebyshev<8>.t[i][y];
      }
    }
  }
};
inline constexpr RowPairBasis kRowPairs;

/// The rows of a block all of whose samples are painted.
inline constexpr auto kFullRows = [] {
  std::array<std::uint32_t, kBlockSides[0]> rows{};
  rows.fill(~std::uint32_t{0});
  return rows;
}();

/// The samples of a block of which the part in the window is painted: a bit for each column of each
/// row. `first` is the block's first sample relative to the window's. `full` where all bits are
/// set: paint_rows() need not look then, which saves 5 % of a frame.
struct PaintedBlock {
  bool full;
  std::ptrdiff_t first;
  const std::uint32_t* rows;
  std::uint32_t clipped[kBlockSides[0]];
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
  /// The halves of vectors go to two rows, `step` apart.
  template <class D, class V>
  HWY_INLINE void store_pair(D, const V (&c)[4], std::ptrdiff_t at, std::ptrdiff_t step,
                             std::uint32_t first_bits, std::uint32_t second_bits) const {
    const hn::Half<D> half;
    const auto first = mask_of(half, first_bits), second = mask_of(half, second_bits);
    each_channel([&](int k) {
      hn::BlendedStore(hn::LowerHalf(half, c[k]), first, half, planes.channel[k] + at);
      hn::BlendedStore(hn::UpperHalf(half, c[k]), second, half, planes.channel[k] + at + step);
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
  HWY_INLINE void store_pair(D d, const V (&c)[4], std::ptrdiff_t at, std::ptrdiff_t step,
                             std::uint32_t first_bits, std::uint32_t second_bits) const {
    const hn::Half<hn::RebindToUnsigned<D>> half;
    const auto words = opaque_words(d, c[0], c[1], c[2]);
    hn::BlendedStore(hn::LowerHalf(half, words), mask_of(half, first_bits), half,
                     pixels.first + at);
    hn::BlendedStore(hn::UpperHalf(half, words), mask_of(half, second_bits), half,
                     pixels.first + at + step);
  }
#endif
};

template <class D, class V>
HWY_INLINE void clamp_colors(D d, V (&c)[4]) {
  const V zero = hn::Zero(d);
  c[3] = hn::Min(hn::Max(c[3], zero), hn::Set(d, 1.0f));
  for (int k = 0; k < 3; ++k) c[k] = hn::Min(hn::Max(c[k], zero), c[3]);
}

/// Values of the channels' polynomials along a row or two of a block's upper half and along those
/// opposite in the lower half, where the odd terms have the other sign.
template <bool opaque, class D, class V>
HWY_INLINE void colors_at(D d, const V (&across)[opaque ? 3 : 4][4], const V (&t)[4], bool clamped,
                          V (&upper)[4], V (&lower)[4]) {
  upper[3] = lower[3] = hn::Set(d, 1.0f);
  for (int k = 0; k < (opaque ? 3 : 4); ++k) {
    const V* const a = across[k];
    const V even = a[0] + a[2] * t[2], odd = a[1] * t[1] + a[3] * t[3];
    upper[k] = even + odd;
    lower[k] = even - odd;
  }
  if (clamped) clamp_colors(d, upper), clamp_colors(d, lower);
}

/// The series down at each of the columns: [channel][term].
template <bool opaque, class D, class V>
HWY_INLINE void series_down(D d, const float* series, const V (&t)[4],
                            V (&across)[opaque ? 3 : 4][4]) {
  for (int k = 0; k < (opaque ? 3 : 4); ++k) {
    for (int j = 0; j < 4; ++j) {
      const float* const a = series + BlockPlan::kTerms * k + 4 * j;
      across[k][j] = (hn::Set(d, a[0]) + hn::Set(d, a[2]) * t[2]) +
                     (hn::Set(d, a[1]) * t[1] + hn::Set(d, a[3]) * t[3]);
    }
  }
}

#if HWY_CAP_GE512
/// Two rows of a block of eight at a time. All of them go through masks, also the empty ones,
/// since branches cannot foresee what blocks are covered.
template <bool opaque, class Target>
HWY_INLINE void paint_pairs(const float* series, bool clamped, const PaintedBlock& block,
                            const Target& target) {
  const hn::CappedTag<float, 16> d;
  const hn::Half<decltype(d)> half;
  using V = hn::Vec<decltype(d)>;
  V t[4], across[opaque ? 3 : 4][4];
  for (int i = 1; i < 4; ++i) {
    const auto row = hn::Load(half, kChebyshev<8>.t[i]);
    t[i] = hn::Combine(d, row, row);
  }
  series_down<opaque>(d, series, t, across);
  const std::ptrdiff_t stride = target.stride();
  const std::uint32_t* const rows = block.rows;
  for (int y = 0; y < 4; y += 2) {
    const int opposite = 7 - y;
    V upper[4], lower[4];
    for (int i = 1; i < 4; ++i) t[i] = hn::Load(d, kRowPairs.t[y / 2][i]);
    colors_at<opaque>(d, across, t, clamped, upper, lower);
    const std::ptrdiff_t above = block.first + y * stride, below = block.first + opposite * stride;
    target.store_pair(d, upper, above, stride, rows[y], rows[y + 1]);
    target.store_pair(d, lower, below, -stride, rows[opposite], rows[opposite - 1]);
  }
}
#endif

template <int kSide, bool opaque, class Target>
HWY_INLINE void paint_rows(const float* series, bool clamped, const PaintedBlock& block,
                           const Target& target) {
  const hn::CappedTag<float, std::min(kSide, 16)> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const std::uint32_t all = (1u << lanes) - 1;
  const auto& basis = kChebyshev<kSide>.t;
  for (int x = 0; x < kSide; x += lanes) {
    V t[4], across[opaque ? 3 : 4][4];
    for (int i = 1; i < 4; ++i) t[i] = hn::Load(d, basis[i] + x);
    series_down<opaque>(d, series, t, across);
    for (int y = 0; y < kSide / 2; ++y) {
      const int rows[2] = {y, kSide - 1 - y};
      std::uint32_t bits[2] = {all, all};
      if (!block.full) {
        for (int i = 0; i < 2; ++i) bits[i] = block.rows[rows[i]] >> x & all;
        if ((bits[0] | bits[1]) == 0) continue;
      }
      V c[2][4];
      for (int i = 1; i < 4; ++i) t[i] = hn::Set(d, basis[i][y]);
      colors_at<opaque>(d, across, t, clamped, c[0], c[1]);
      for (int i = 0; i < 2; ++i) {
        const std::ptrdiff_t at = block.first + rows[i] * target.stride() + x;
        if (bits[i] == all) {
          target.store(d, c[i], at);
        } else if (bits[i] != 0) {
          target.store_some(d, c[i], at, bits[i]);
        }
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
  const std::uint32_t* const rows = b.full ? kFullRows.data() : plan.rows.data() + b.coverage;
  painted.rows = rows;
  if (whole) return true;
  const std::uint32_t columns = bit_range(begin, end);
  for (int y = 0; y < b.side; ++y) {
    painted.clipped[y] = y < first || y >= last ? 0 : rows[y] & columns;
  }
  painted.rows = painted.clipped;
  return true;
}

template <bool opaque, class Target>
HWY_INLINE void paint_all(const BlockPlan& plan, const SampleWindow& window, const Target& target) {
  PaintedBlock painted;
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) {
    const BlockPlan::Block& block = plan.blocks[i];
    if (!clip(plan, block, window, target.stride(), painted)) continue;
    const float* const series = plan.series.data() + BlockPlan::kTerms * (opaque ? 3 : 4) * i;
    switch (block.side) {
      case 8:
#if HWY_CAP_GE512
        paint_pairs<opaque>(series, block.clamped, painted, target);
#else
        paint_rows<8, opaque>(series, block.clamped, painted, target);
#endif
        break;
      case 16:
        paint_rows<16, opaque>(series, block.clamped, painted, target);
        break;
      default:
        paint_rows<32, opaque>(series, block.clamped, painted, target);
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
