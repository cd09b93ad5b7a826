#include "pixel_stream.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pixel_stream.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void stream(const std::byte* from, std::ptrdiff_t from_stride, int width, int height, std::byte* to,
            std::ptrdiff_t to_stride) {
  const hn::CappedTag<std::uint8_t, 64> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  constexpr int kLine = 64;
  for (int y = 0; y < height; ++y, from += from_stride, to += to_stride) {
    const int past = static_cast<int>(reinterpret_cast<std::uintptr_t>(to) % kLine);
    const int head = std::min((kLine - past) % kLine, width);
    std::memcpy(to, from, head);
    int x = head;
    for (; x + kLine <= width; x += kLine) {
      for (int i = 0; i < kLine; i += lanes) {
        const auto v = hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(from + x + i));
        hn::Stream(v, d, reinterpret_cast<std::uint8_t*>(to + x + i));
      }
    }
    std::memcpy(to + x, from + x, width - x);
  }
  hwy::FlushStream();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(stream);
}  // namespace

void stream_rows(const std::byte* from, std::ptrdiff_t from_stride, int width, int height,
                 std::byte* to, std::ptrdiff_t to_stride) {
  HWY_DYNAMIC_DISPATCH(stream)(from, from_stride, width, height, to, to_stride);
}

}  // namespace quadrille
#endif
