#include "quadrille/raster_file.h"

#include <algorithm>
#include <cstdint>

#include "quadrille/renderer.h"
#include "raster_stream.h"

namespace quadrille {
namespace {

/// The strip's share of the progress of the whole.
RunContext strip_context(const RunContext& context, int y, int rows, int height) {
  RunContext part = context;
  part.on_stage = nullptr;
  if (context.on_progress) {
    part.on_progress = [&context, y, rows, height](const std::string& stage, double fraction) {
      return context.on_progress(stage, (y + fraction * rows) / height);
    };
  }
  return part;
}

template <class Sample>
void quantize(const float* pixel, bool has_alpha, const std::array<float, 3>& background,
              int channels, float full, Sample* out) {
  const float alpha = has_alpha ? std::clamp(pixel[3], 0.0f, 1.0f) : 1.0f;
  for (int c = 0; c < 3; ++c) {
    float value = std::clamp(pixel[c], 0.0f, 1.0f);
    if (channels == 3) value = value * alpha + background[c] * (1 - alpha);
    out[c] = static_cast<Sample>(value * full + 0.5f);
  }
  if (channels == 4) out[3] = static_cast<Sample>(alpha * full + 0.5f);
}

void quantize_row(const Raster& picture, int y, const std::array<float, 3>& background,
                  const PixelLayout& layout, std::byte* row) {
  for (int x = 0; x < picture.width; ++x) {
    const float* const pixel = picture.pixel(x, y);
    const std::ptrdiff_t at = std::ptrdiff_t{1} * x * layout.channels;
    if (layout.type == SampleType::uint8) {
      quantize(pixel, picture.has_alpha(), background, layout.channels, 255.0f,
               reinterpret_cast<std::uint8_t*>(row) + at);
    } else {
      quantize(pixel, picture.has_alpha(), background, layout.channels, 65535.0f,
               reinterpret_cast<std::uint16_t*>(row) + at);
    }
  }
}

}  // namespace

void save_raster(const Raster& picture, const std::filesystem::path& path,
                 const RasterFileOptions& options) {
  const auto draw = [&](int y, int rows, const PixelLayout& layout, const PixelBuffer& buffer) {
    for (int row = 0; row < rows; ++row) {
      quantize_row(picture, y + row, options.background, layout,
                   static_cast<std::byte*>(buffer.pixels) + row * buffer.row_bytes);
    }
  };
  write_stream({picture.width, picture.height, picture.has_alpha(), draw}, path, options);
}

void write_raster_file(const VectorImage& image, const std::filesystem::path& path,
                       const RasterFileOptions& options, const RunContext& context) {
  RenderOptions render_options;
  render_options.scale = options.scale;
  render_options.width = options.width;
  const auto [width, height] = output_size(image, render_options);
  Renderer renderer(image);
  const auto draw = [&, width = width, height = height](int y, int rows, const PixelLayout& layout,
                                                        const PixelBuffer& buffer) {
    RenderOptions strip = render_options;
    strip.region = PixelRegion{0, y, width, rows};
    if (layout.channels == 3 && !renderer.opaque()) {
      const auto& behind = options.background;
      strip.background = {behind[0], behind[1], behind[2], 1};
    }
    renderer.draw(strip, layout, buffer, strip_context(context, y, rows, height));
  };
  write_stream({width, height, !renderer.opaque(), draw}, path, options);
}

}  // namespace quadrille
