#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quadrille/renderer.h"

namespace quadrille {

/// Rows of premultiplied samples, a plane per channel, `stride` floats from row to row. Without
/// alpha the fourth plane is not looked at. 16 floats after the last row can be read.
struct SamplePlanes {
  std::array<float*, 4> channel = {};
  std::ptrdiff_t stride = 0;
  bool has_alpha = true;
};

/// Rows of opaque 8-bit pixels of four channels, `stride` from row to row.
struct PixelWords {
  std::uint32_t* first = nullptr;
  std::ptrdiff_t stride = 0;
};

/// Puts premultiplied samples over a background and writes them as output pixels.
class PixelPacker {
 public:
  /// The background is straight and clamped to [0, 1]. Throws Error{invalid_argument} for one that
  /// is not finite.
  PixelPacker(const std::array<float, 4>& background, const PixelLayout& layout);

  /// Writes width x height pixels, `row_bytes` from row to row. All instruction sets give the same
  /// bits.
  void write(const SamplePlanes& samples, int width, int height, std::byte* pixels,
             std::ptrdiff_t row_bytes) const;

 private:
  std::array<float, 4> behind_;  // premultiplied
  PixelLayout layout_;
};

}  // namespace quadrille
