// Colours as words of 8-bit pixels; compiled once per instruction set.
#include <cstdint>

#if defined(QUADRILLE_PIXEL_WORDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRILLE_PIXEL_WORDS_INL_H
#undef QUADRILLE_PIXEL_WORDS_INL_H
#else
#define QUADRILLE_PIXEL_WORDS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

/// Values in [0, 1] as whole numbers up to 255 in the lowest byte, rounded to the nearest; the next
/// two bytes are zero, the highest is not. Floats from 2^23 on lie one apart; the factor is two
/// floats above 255, so that halves are rounded up.
template <class D>
HWY_INLINE auto low_bytes(D d, const hwy::HWY_NAMESPACE::Vec<D>& v) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::BitCast(hn::RebindToUnsigned<D>(),
                     v * hn::Set(d, 255.00003f) + hn::Set(d, 8388608.0f));
}

/// Opaque pixels with red in the lowest byte.
template <class D>
HWY_INLINE auto opaque_words(D d, const hwy::HWY_NAMESPACE::Vec<D>& red,
                             const hwy::HWY_NAMESPACE::Vec<D>& green,
                             const hwy::HWY_NAMESPACE::Vec<D>& blue) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToUnsigned<D> du;
  const auto upper =
      hn::Or(hn::ShiftLeft<16>(low_bytes(d, blue)), hn::Set(du, std::uint32_t{0xff000000}));
  return hn::Or(hn::Or(low_bytes(d, red), hn::ShiftLeft<8>(low_bytes(d, green))), upper);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#endif
