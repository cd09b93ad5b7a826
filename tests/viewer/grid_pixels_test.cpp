#include "grid_pixels.h"

#include <gtest/gtest.h>

#include "quadrille/picture_layers.h"

namespace quadrille::viewer {
namespace {

std::vector<std::uint8_t> drawn(const Raster& picture, double scale, const PixelRegion& region) {
  const SceneLayer layer = raster_layer(picture);
  std::vector<std::uint8_t> pixels(4 * region.width * region.height);
  draw_grid(std::get<SceneGrid>(layer.content), layer.style, {scale, scale}, region, pixels.data(),
            4 * region.width);
  return pixels;
}

Raster gray_ramp(int width, int height) {
  Raster picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::fill_n(picture.pixel(x, y), 3, static_cast<float>((x + width * y) / 255.0));
    }
  }
  return picture;
}

TEST(DrawGrid, EnlargedPixelsAreSquares) {
  const auto pixels = drawn(gray_ramp(8, 8), 3, {0, 0, 24, 24});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      EXPECT_EQ(pixels[4 * (24 * y + x)], x / 3 + 8 * (y / 3));
      EXPECT_EQ(pixels[4 * (24 * y + x) + 3], 255);
    }
  }
}

TEST(DrawGrid, ReducedPixelsAreMeans) {
  const auto pixels = drawn(gray_ramp(8, 8), 0.5, {1, 2, 3, 2});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      const double mean = 2 * (x + 1) + 0.5 + 8 * (2 * (y + 2) + 0.5);
      EXPECT_NEAR(pixels[4 * (3 * y + x)], mean, 0.5);
    }
  }
}

TEST(DrawGrid, TransparentPixelsHaveNoSayInTheColor) {
  Raster picture(2, 2, 4);
  picture.data = {1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  const auto pixels = drawn(picture, 0.5, {0, 0, 1, 1});
  EXPECT_EQ(pixels, (std::vector<std::uint8_t>{255, 0, 0, 64}));
}

}  // namespace
}  // namespace quadrille::viewer
