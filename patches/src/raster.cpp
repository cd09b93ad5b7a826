#include "quadrille/raster.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"

namespace quadrille {

Raster::Raster(int width, int height, int channels)
    : width(width), height(height), channels(channels) {
  if (width < 1 || height < 1 || (channels != 3 && channels != 4)) {
    throw Error(ErrorCode::invalid_argument,
                "a raster of " + std::to_string(width) + " x " + std::to_string(height) + " with " +
                    std::to_string(channels) +
                    " channels cannot be made; use sides of at least 1 and 3 or 4 channels");
  }
  data.assign(static_cast<std::size_t>(width) * height * channels, 0.0f);
}

void check_raster(const Raster& picture) {
  const auto expected = static_cast<std::size_t>(std::max(0, picture.width)) *
                        std::max(0, picture.height) * std::max(0, picture.channels);
  if (picture.data.empty() || (picture.channels != 3 && picture.channels != 4) ||
      picture.data.size() != expected) {
    throw Error(ErrorCode::invalid_argument,
                "the raster holds " + std::to_string(picture.data.size()) +
                    " samples, which its size and channels contradict; set all of them together");
  }
  if (!std::all_of(picture.data.begin(), picture.data.end(),
                   [](float v) { return std::isfinite(v); })) {
    throw Error(ErrorCode::invalid_argument,
                "the raster has samples that are not finite; replace them first");
  }
}

Raster crop(const Raster& picture, int x, int y, int w, int h) {
  if (x < 0 || y < 0 || w < 1 || h < 1 || x > picture.width - w || y > picture.height - h) {
    throw Error(ErrorCode::invalid_argument,
                "the region " + std::to_string(x) + "," + std::to_string(y) + "," +
                    std::to_string(w) + "," + std::to_string(h) + " is not inside the " +
                    std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                    " picture; choose one that is");
  }
  Raster part(w, h, picture.channels);
  for (int row = 0; row < h; ++row) {
    std::copy_n(picture.pixel(x, y + row), static_cast<std::size_t>(w) * picture.channels,
                part.pixel(0, row));
  }
  return part;
}

}  // namespace quadrille
