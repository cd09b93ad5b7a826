#pragma once

#include <filesystem>
#include <functional>

#include "quadrille/export.h"
#include "quadrille/renderer.h"

namespace quadrille {

/// A picture that is drawn strip by strip while it is written, so that its size is bounded by the
/// disk and not by the memory.
struct RasterStream {
  int width = 0;
  int height = 0;
  bool has_alpha = false;
  /// Writes the rows [y, y + rows) at full width in the layout asked for: 8 or 16 bits a channel,
  /// straight, and 3 channels only where there is no alpha or the format has none; then over the
  /// options' background. Called from one thread at a time, mostly from the top down. What it
  /// throws ends the writing and reaches the caller.
  std::function<void(int y, int rows, const PixelLayout& layout, const PixelBuffer& buffer)> draw;
  /// About so many pixels are drawn at once, at least 16 rows: enough to keep all threads of the
  /// renderer busy.
  long long strip_pixels = 16'000'000;
};

/// Writes the picture in the format of the ending of the path, tagged as sRGB. A deep-zoom pyramid
/// NAME.dzi has its tiles in the folder NAME_files beside it, which replaces that of a NAME.dzi
/// that was there before. Nothing stays behind when the writing ends early. Throws
/// Error{unsupported_format}, Error{invalid_argument} for bits or quality out of range,
/// Error{limit_exceeded} for a size the format cannot hold, Error{io_failure}.
void write_stream(const RasterStream& stream, const std::filesystem::path& path,
                  const RasterFileOptions& options);

}  // namespace quadrille
