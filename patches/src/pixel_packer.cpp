#include "pixel_packer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "quadrille/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pixel_packer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pixel_words-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 16>;
using V = hn::Vec<Floats>;

/// Whether four bytes can be put together as one word.
constexpr bool kPacksWords = std::endian::native == std::endian::little && HWY_TARGET != HWY_SCALAR;

/// Values in [0, 1] as whole numbers, rounded half up; floats as they are.
template <class Sample>
HWY_INLINE auto quantized(const V& v) {
  if constexpr (std::is_same_v<Sample, float>) {
    return v;
  } else if constexpr (sizeof(Sample) == 1) {
    return hn::TruncateTo(hn::Rebind<Sample, Floats>(), low_bytes(Floats(), v));
  } else {
    const Floats d;
    const V scaled = v * hn::Set(d, 65535.0f) + hn::Set(d, 0.5f);
    return hn::DemoteTo(hn::Rebind<Sample, Floats>(),
                        hn::ConvertTo(hn::RebindToSigned<Floats>(), scaled));
  }
}

template <class Sample, int channels>
HWY_INLINE void write_vector(const V (&c)[4], Sample* out) {
  const hn::Rebind<Sample, Floats> d;
  if constexpr (channels == 4 && sizeof(Sample) == 1 && kPacksWords) {
    const Floats df;
    const auto words = hn::Or(hn::AndNot(hn::Set(hn::RebindToUnsigned<Floats>(), 0xff000000u),
                                         opaque_words(df, c[0], c[1], c[2])),
                              hn::ShiftLeft<24>(low_bytes(df, c[3])));
    hn::StoreU(hn::BitCast(hn::Repartition<Sample, Floats>(), words),
               hn::Repartition<Sample, Floats>(), out);
  } else if constexpr (channels == 3) {
    hn::StoreInterleaved3(quantized<Sample>(c[0]), quantized<Sample>(c[1]), quantized<Sample>(c[2]),
                          d, out);
  } else {
    hn::StoreInterleaved4(quantized<Sample>(c[0]), quantized<Sample>(c[1]), quantized<Sample>(c[2]),
                          quantized<Sample>(c[3]), d, out);
  }
}

/// One vector of samples over the background, as straight or premultiplied pixels.
template <class Sample, bool has_alpha>
HWY_INLINE void finish(const float* const (&in)[4], int x, const std::array<float, 4>& behind,
                       bool premultiplied, V (&c)[4]) {
  const Floats d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (int k = 0; k < 3; ++k) c[k] = hn::LoadU(d, in[k] + x);
  c[3] = one;
  if constexpr (has_alpha) {
    c[3] = hn::LoadU(d, in[3] + x);
    const V through = one - c[3];
    for (int k = 0; k < 4; ++k) c[k] = c[k] + hn::Set(d, behind[k]) * through;
    if (premultiplied) {
      c[3] = hn::Min(hn::Max(c[3], zero), one);
    } else {
      c[3] = hn::Min(hn::Max(c[3], zero), one);
      const V divisor = hn::IfThenElse(c[3] > zero, c[3], one);
      for (int k = 0; k < 3; ++k) c[k] = c[k] / divisor;
    }
  }
  // Opaque samples lie in [0, 1] but for rounding, which whole numbers swallow.
  if constexpr (has_alpha || std::is_same_v<Sample, float>) {
    for (int k = 0; k < 3; ++k) {
      c[k] = hn::Min(hn::Max(c[k], zero), premultiplied ? c[3] : one);
    }
  }
}

template <class Sample, int channels, bool has_alpha>
void pack_rows(const SamplePlanes& samples, int width, int height,
               const std::array<float, 4>& behind, bool premultiplied, std::byte* pixels,
               std::ptrdiff_t row_bytes) {
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  alignas(64) Sample rest[16 * channels];
  for (int y = 0; y < height; ++y) {
    const float* in[4];
    for (int k = 0; k < 4; ++k) {
      in[k] = k < 3 || has_alpha ? samples.channel[k] + y * samples.stride : nullptr;
    }
    Sample* const out = reinterpret_cast<Sample*>(pixels + y * row_bytes);
    int x = 0;
    for (; x + lanes <= width; x += lanes) {
      V c[4];
      finish<Sample, has_alpha>(in, x, behind, premultiplied, c);
      write_vector<Sample, channels>(c, out + x * channels);
    }
    if (x < width) {
      V c[4];
      finish<Sample, has_alpha>(in, x, behind, premultiplied, c);
      write_vector<Sample, channels>(c, rest);
      std::memcpy(out + x * channels, rest, sizeof(Sample) * channels * (width - x));
    }
  }
}

template <class Sample>
void pack_as(const SamplePlanes& samples, int width, int height, const std::array<float, 4>& behind,
             const PixelLayout& layout, std::byte* pixels, std::ptrdiff_t row_bytes) {
  const auto pack_rows_of =
      layout.channels == 3
          ? (samples.has_alpha ? pack_rows<Sample, 3, true> : pack_rows<Sample, 3, false>)
          : (samples.has_alpha ? pack_rows<Sample, 4, true> : pack_rows<Sample, 4, false>);
  pack_rows_of(samples, width, height, behind, layout.premultiplied, pixels, row_bytes);
}

void pack(const SamplePlanes& samples, int width, int height, const std::array<float, 4>& behind,
          const PixelLayout& layout, std::byte* pixels, std::ptrdiff_t row_bytes) {
  switch (layout.type) {
    case SampleType::uint8:
      return pack_as<std::uint8_t>(samples, width, height, behind, layout, pixels, row_bytes);
    case SampleType::uint16:
      return pack_as<std::uint16_t>(samples, width, height, behind, layout, pixels, row_bytes);
    case SampleType::float32:
      return pack_as<float>(samples, width, height, behind, layout, pixels, row_bytes);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(pack);
}  // namespace

PixelPacker::PixelPacker(const std::array<float, 4>& background, const PixelLayout& layout)
    : layout_(layout) {
  for (int k = 0; k < 4; ++k) {
    if (!std::isfinite(background[k])) {
      throw Error(ErrorCode::invalid_argument,
                  "a background component is not a finite number; use values from 0 to 1");
    }
    behind_[k] = std::clamp(background[k], 0.0f, 1.0f);
  }
  for (int k = 0; k < 3; ++k) behind_[k] *= behind_[3];
}

void PixelPacker::write(const SamplePlanes& samples, int width, int height, std::byte* pixels,
                        std::ptrdiff_t row_bytes) const {
  HWY_DYNAMIC_DISPATCH(pack)(samples, width, height, behind_, layout_, pixels, row_bytes);
}

}  // namespace quadrille
#endif
