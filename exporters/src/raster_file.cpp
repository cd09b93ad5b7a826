#include "quadrille/raster_file.h"

#include "quadrille/render.h"
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

}  // namespace

void save_raster(const Raster& picture, const std::filesystem::path& path,
                 const RasterFileOptions& options) {
  write_stream({picture.width, picture.height, picture.has_alpha(),
                [&](int y, int rows) { return crop(picture, 0, y, picture.width, rows); }},
               path, options);
}

void write_raster_file(const VectorImage& image, const std::filesystem::path& path,
                       const RasterFileOptions& options, const RunContext& context) {
  RenderOptions render_options;
  render_options.scale = options.scale;
  render_options.width = options.width;
  const auto [width, height] = output_size(image, render_options);
  const auto draw = [&, width = width, height = height](int y, int rows) {
    RenderOptions strip = render_options;
    strip.region = PixelRegion{0, y, width, rows};
    return render(image, strip, strip_context(context, y, rows, height));
  };
  write_stream({width, height, !image.opaque(), draw}, path, options);
}

}  // namespace quadrille
