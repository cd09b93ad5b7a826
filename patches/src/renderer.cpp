#include "quadrille/renderer.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <bit>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include "pixel_packer.h"
#include "pixel_stream.h"
#include "quadrille/error.h"
#include "tile_grid.h"
#include "tile_painter.h"

namespace quadrille {
namespace {

std::ptrdiff_t bytes_of(SampleType type) {
  return type == SampleType::uint8 ? 1 : type == SampleType::uint16 ? 2 : 4;
}

void check_layout(const PixelLayout& layout, bool opaque) {
  if (layout.channels == 4 || (layout.channels == 3 && opaque)) return;
  throw Error(ErrorCode::invalid_argument,
              "a picture" + std::string(opaque ? "" : " with transparency") +
                  " cannot be drawn into " + std::to_string(layout.channels) + " channels; use 4" +
                  (opaque ? " or 3" : ", or put an opaque background behind it"));
}

/// Larger regions do not stay in the caches.
constexpr double kCachedBytes = 4 << 20;

/// Whether a pixel is a PixelWords' word.
bool holds_words(const PixelLayout& layout) {
  return std::endian::native == std::endian::little && layout.type == SampleType::uint8 &&
         layout.channels == 4;
}

void copy(const PixelWords& words, const PixelRegion& tile, bool streamed, std::byte* pixels,
          std::ptrdiff_t row_bytes) {
  const std::ptrdiff_t word = sizeof(words.first[0]);
  if (streamed) {
    return stream_rows(reinterpret_cast<const std::byte*>(words.first), word * words.stride,
                       static_cast<int>(word) * tile.width, tile.height, pixels, row_bytes);
  }
  for (int y = 0; y < tile.height; ++y) {
    std::memcpy(pixels + y * row_bytes, words.first + y * words.stride,
                sizeof(words.first[0]) * tile.width);
  }
}

}  // namespace

class Renderer::Implementation {
 public:
  explicit Implementation(const VectorImage& image) : image_(image), opaque_(image.opaque()) {}

  bool opaque(const RenderOptions& options) const { return opaque_ || options.background[3] >= 1; }

  void draw(const RenderOptions& options, const PixelLayout& layout, const PixelBuffer& buffer,
            const RunContext& context) {
    const OutputFrame frame = output_frame(image_, options);
    check_layout(layout, opaque(options));
    const PixelPacker packer(options.background, layout);
    arena_.set_threads(context);
    prepare(frame);
    // A single opaque layer that fills the picture needs no alpha on the way.
    const bool with_alpha = !opaque_ || scenes_.size() > 1;
    const TileGrid grid(frame);
    std::mutex reporting;
    std::size_t done = 0;
    const bool as_words = !with_alpha && frame.box == std::array{1, 1} && holds_words(layout);
    const bool streamed = 4.0 * frame.region.width * frame.region.height > kCachedBytes;
    arena_.for_each(grid.size(), [&](std::size_t index) {
      const PixelRegion tile = grid.tile(index);
      TilePainter& painter = painters_.local();
      const std::ptrdiff_t left = tile.x - frame.region.x, top = tile.y - frame.region.y;
      std::byte* const corner = static_cast<std::byte*>(buffer.pixels) + top * buffer.row_bytes +
                                left * layout.channels * bytes_of(layout.type);
      if (as_words) {
        copy(painter.paint_words(scenes_[0], tile, packer), tile, streamed, corner,
             buffer.row_bytes);
      } else {
        const SamplePlanes& samples = painter.paint(scenes_, frame, tile, with_alpha);
        packer.write(samples, tile.width, tile.height, corner, buffer.row_bytes);
      }
      if (!context.on_progress) return;
      const std::lock_guard lock(reporting);
      context.progress("render", static_cast<double>(++done) / static_cast<double>(grid.size()));
    });
  }

 private:
  const VectorImage& image_;
  bool opaque_;
  WorkArena arena_;
  std::vector<LayerScene> scenes_;
  tbb::enumerable_thread_specific<TilePainter> painters_;

  void prepare(const OutputFrame& frame) {
    if (scenes_.empty()) {
      std::vector<LayerScene> scenes;  // all layers' or, where one is refused, none
      for (const Layer& layer : image_.layers) scenes.emplace_back(layer, arena_);
      scenes_ = std::move(scenes);
    }
    for (LayerScene& scene : scenes_) {
      scene.prepare(frame.scale, samples_of(frame.region, frame.box), arena_);
      scene.prepare_programs(arena_);
    }
  }
};

Renderer::Renderer(const VectorImage& image)
    : implementation_(std::make_unique<Implementation>(image)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

bool Renderer::opaque(const RenderOptions& options) const {
  return implementation_->opaque(options);
}

void Renderer::draw(const RenderOptions& options, const PixelLayout& layout,
                    const PixelBuffer& buffer, const RunContext& context) {
  implementation_->draw(options, layout, buffer, context);
}

}  // namespace quadrille
