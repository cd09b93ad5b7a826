#include "gltf_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "quadrille/render.h"

namespace quadrille {
namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(double(value), 0.0, 1.0) * 255 + 0.5);
}

RenderOptions texture_size(const VectorImage& image, double texels_per_pixel) {
  RenderOptions options;
  const double side = std::max(image.width, image.height);
  options.scale = std::min(texels_per_pixel, kMaxTextureSide / side);
  return options;
}

/// Draws in bands, because a whole picture of float samples is four times the texture's size.
Texture draw(const VectorImage& image, RenderOptions options, const RunContext& context) {
  constexpr int kTexelsPerBand = 1 << 22;
  Texture texture;
  const auto [width, height] = output_size(image, options);
  texture.width = width;
  texture.height = height;
  const int rows = std::max(1, kTexelsPerBand / width);
  RunContext quiet;
  quiet.threads = context.threads;
  for (int y = 0; y < height; y += rows) {
    context.progress("texture", double(y) / height);
    options.region = PixelRegion{0, y, width, std::min(rows, height - y)};
    const Raster band = render(image, options, quiet);
    texture.channels = band.channels;
    std::transform(band.data.begin(), band.data.end(), std::back_inserter(texture.data), to_byte);
  }
  context.progress("texture", 1);
  return texture;
}

void drop_alpha(Texture& texture) {
  const std::size_t texels = texture.data.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    std::copy_n(&texture.data[4 * i], 3, &texture.data[3 * i]);
  }
  texture.data.resize(3 * texels);
  texture.channels = 3;
}

/// The same outline filled with opaque paint: its alpha is the coverage.
VectorImage opaque_silhouette(const VectorImage& image) {
  VectorImage silhouette = image;
  PatchMesh& patches = silhouette.layers.front().patches;
  patches.opaque = true;
  Wedge black;
  black.value = Color(0, 0, 0, 1);
  std::fill(patches.wedges.begin(), patches.wedges.end(), black);
  return silhouette;
}

}  // namespace

Texture layer_texture(const VectorImage& image, const Layer& layer, double texels_per_pixel,
                      const RunContext& context) {
  const VectorImage alone{image.width, image.height, {layer}, {}};
  const RenderOptions options = texture_size(image, texels_per_pixel);
  Texture texture = draw(alone, options, context);
  if (texture.channels == 3) return texture;

  const std::size_t texels = texture.data.size() / 4;
  std::vector<std::uint8_t> known(texels);
  for (std::size_t i = 0; i < texels; ++i) known[i] = texture.data[4 * i + 3] > 0;
  fill_unknown(texture, 0, 3, known);
  if (layer.patches.opaque) {
    drop_alpha(texture);
    return texture;
  }

  const VectorImage silhouette = opaque_silhouette(alone);
  if (silhouette.opaque()) return texture;
  const Texture coverage = draw(silhouette, options, context);
  for (std::size_t i = 0; i < texels; ++i) {
    const float covered = coverage.data[4 * i + 3];
    std::uint8_t& alpha = texture.data[4 * i + 3];
    known[i] = covered > 0;
    if (covered > 0) alpha = to_byte(alpha / covered);
  }
  fill_unknown(texture, 3, 1, known);
  return texture;
}

void fill_unknown(Texture& texture, int first, int count, const std::vector<std::uint8_t>& known) {
  if (std::find(known.begin(), known.end(), 0) == known.end()) return;
  if (texture.width == 1 && texture.height == 1) return;
  const int channels = texture.channels;
  Texture half{(texture.width + 1) / 2, (texture.height + 1) / 2, channels, {}};
  const std::size_t half_texels = std::size_t(half.width) * half.height;
  half.data.resize(half_texels * channels);
  std::vector<std::uint8_t> half_known(half_texels);

  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const std::size_t parent = std::size_t(y) * half.width + x;
      std::array<int, 4> sum{};
      int children = 0;
      for (int cy = 2 * y; cy < std::min(2 * y + 2, texture.height); ++cy) {
        for (int cx = 2 * x; cx < std::min(2 * x + 2, texture.width); ++cx) {
          const std::size_t child = std::size_t(cy) * texture.width + cx;
          if (!known[child]) continue;
          ++children;
          for (int c = 0; c < count; ++c) sum[c] += texture.data[child * channels + first + c];
        }
      }
      half_known[parent] = children > 0;
      for (int c = 0; c < count && children > 0; ++c) {
        half.data[parent * channels + first + c] = (sum[c] + children / 2) / children;
      }
    }
  }
  fill_unknown(half, first, count, half_known);

  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const std::size_t child = std::size_t(y) * texture.width + x;
      if (known[child]) continue;
      const std::size_t parent = std::size_t(y / 2) * half.width + x / 2;
      std::copy_n(&half.data[parent * channels + first], count,
                  &texture.data[child * channels + first]);
    }
  }
}

}  // namespace quadrille
