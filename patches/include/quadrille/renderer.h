#pragma once

#include <cstddef>
#include <memory>

#include "quadrille/render.h"

namespace quadrille {

enum class SampleType { uint8, uint16, float32 };

/// How pixels lie in memory: channels interleaved, red first.
struct PixelLayout {
  SampleType type =
      SampleType::uint8;       ///< whole numbers are rounded from [0, 1] to their full range
  int channels = 4;            ///< 3 (RGB, for opaque results only) or 4 (RGBA)
  bool premultiplied = false;  ///< colours times alpha; straight otherwise
  bool operator==(const PixelLayout&) const = default;
};

/// Memory for the pixels of a region.
struct PixelBuffer {
  void* pixels = nullptr;        ///< the region's top left pixel, aligned to the sample type
  std::ptrdiff_t row_bytes = 0;  ///< from row to row; may be negative
};

/// Draws a picture again and again, as a viewer does for every frame: patches are set up when first
/// seen and kept, some 900 bytes each, and so are, while the scale stays the same, outlines and up
/// to 200 MB of blocks. After a first drawing, another one of the same region and layout by one
/// thread allocates no memory, and others only where they see more than before.
///
/// What is drawn is documented at render(), which is a Renderer used once. An object serves one
/// call at a time; the threads are inside.
class Renderer {
 public:
  /// Keeps a reference to the picture, which must not change.
  explicit Renderer(const VectorImage& image);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Whether the result is opaque everywhere by construction: the picture or the background is.
  bool opaque(const RenderOptions& options = {}) const;

  /// Draws options.region, or the whole, into the buffer. Throws what render() throws, and
  /// Error{invalid_argument} for 3 channels where the result is not opaque, or other than 3 or 4.
  void draw(const RenderOptions& options, const PixelLayout& layout, const PixelBuffer& buffer,
            const RunContext& context = {});

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace quadrille
