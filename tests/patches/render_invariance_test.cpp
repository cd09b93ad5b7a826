// What must not change the pixels: the order of tiles, whole shifts, and where a factor of two of
// the size comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "quadrille/renderer.h"
#include "render_scenes.h"

namespace quadrille {
namespace {

using testing::at_scale;
using testing::Random;
using testing::random_image;

struct Pixels {
  int width, height;
  std::vector<std::uint8_t> bytes;  // 4 a pixel

  const std::uint8_t* at(int x, int y) const {
    return bytes.data() + 4 * (std::size_t{1} * y * width + x);
  }
};

Pixels blank(const VectorImage& image, const RenderOptions& options) {
  const auto [width, height] = output_size(image, options);
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
}

Pixels draw(const VectorImage& image, const RenderOptions& options) {
  Pixels pixels = blank(image, options);
  Renderer(image).draw(options, {}, {pixels.bytes.data(), 4 * pixels.width});
  return pixels;
}

/// Two layers with an outline and transparency. Coordinates are multiples of 2^-10, so that whole
/// shifts and powers of two do not round.
VectorImage dyadic_image(std::uint32_t seed) {
  VectorImage image = random_image(seed, false);
  image.layers.push_back(random_image(seed + 1, true).layers[0]);
  image.layers[1].transform.translate(Eigen::Vector2d(9.25, 5.5)).scale(0.5);
  const auto rounded = [](Eigen::Vector2d& p) { p = (p * 1024).array().round() / 1024; };
  for (Layer& layer : image.layers) {
    for (auto& p : layer.patches.mesh.vertices) rounded(p);
    for (auto& edge : layer.patches.edge_tangents) {
      for (auto& t : edge) rounded(t);
    }
  }
  return image;
}

TEST(RenderInvariance, TheOrderOfTilesDoesNotMatter) {
  const VectorImage image = dyadic_image(21);
  Random random(5);
  for (const double scale : {0.4, 1.0, 6.0, 17.0}) {
    RenderOptions options = at_scale(scale);
    const Pixels whole = draw(image, options);
    Pixels tiled = blank(image, options);
    const int side = random.integer(5, 90);
    std::vector<PixelRegion> tiles;
    for (int y = 0; y < whole.height; y += side) {
      for (int x = 0; x < whole.width; x += side) {
        tiles.push_back({x, y, std::min(side, whole.width - x), std::min(side, whole.height - y)});
      }
    }
    for (std::size_t i = tiles.size(); i > 1; --i) {
      std::swap(tiles[i - 1], tiles[random.integer(0, static_cast<int>(i) - 1)]);
    }
    Renderer renderer(image);
    for (const PixelRegion& tile : tiles) {
      options.region = tile;
      std::uint8_t* const corner =
          tiled.bytes.data() + 4 * (std::size_t{1} * tile.y * tiled.width + tile.x);
      renderer.draw(options, {}, {corner, 4 * tiled.width});
    }
    EXPECT_TRUE(tiled.bytes == whole.bytes) << "scale " << scale << " tiles of " << side;
  }
}

/// Bytes of `moved` that differ from those of `plain` (shift[0], shift[1]) pixels before.
struct Differences {
  long count = 0, compared = 0;
  int largest = 0;
};
Differences compare_shifted(const Pixels& plain, const Pixels& moved,
                            const std::array<int, 2>& shift) {
  Differences differences;
  for (int y = 0; y < plain.height; ++y) {
    for (int x = 0; x < plain.width; ++x) {
      const std::uint8_t *a = plain.at(x, y), *b = moved.at(x + shift[0], y + shift[1]);
      for (int k = 0; k < 4; ++k) {
        ++differences.compared;
        differences.count += a[k] != b[k];
        differences.largest = std::max(differences.largest, std::abs(a[k] - b[k]));
      }
    }
  }
  return differences;
}

TEST(RenderInvariance, WholeShiftsShiftTheBytes) {
  const VectorImage image = dyadic_image(23);
  for (const int scale : {1, 8}) {
    const Pixels plain = draw(image, at_scale(scale));
    for (const std::array<int, 2>& shift :
         {std::array{32, 0}, {64, 32}, {0, 128}, {1, 0}, {5, 17}, {40, 131}}) {
      VectorImage moved = image;
      moved.width += 64, moved.height += 144;
      const Eigen::Vector2d by = Eigen::Vector2d(shift[0], shift[1]) / static_cast<double>(scale);
      for (Layer& layer : moved.layers) layer.transform.pretranslate(by);
      const Differences found = compare_shifted(plain, draw(moved, at_scale(scale)), shift);
      // Elsewhere other blocks give colours that differ by a hundredth of a step before rounding.
      const bool same_blocks = shift[0] % 32 == 0 && shift[1] % 32 == 0;
      EXPECT_LE(found.largest, same_blocks ? 0 : 1) << scale << ": " << shift[0] << "," << shift[1];
      EXPECT_LE(static_cast<double>(found.count), 0.01 * static_cast<double>(found.compared))
          << scale << ": " << shift[0] << "," << shift[1];
    }
  }
}

TEST(RenderInvariance, TwiceTheSizeAtHalfTheScaleIsTheSame) {
  const VectorImage image = dyadic_image(25);
  VectorImage large = image;
  large.width *= 2, large.height *= 2;
  for (Layer& layer : large.layers) layer.transform.prescale(2);
  for (const double scale : {2.0, 4.0, 11.0}) {
    EXPECT_TRUE(draw(image, at_scale(scale)).bytes == draw(large, at_scale(scale / 2)).bytes)
        << "scale " << scale;
  }
}

}  // namespace
}  // namespace quadrille
