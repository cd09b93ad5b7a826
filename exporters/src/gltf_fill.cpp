#include <algorithm>
#include <array>

#include "gltf_texture.h"

namespace quadrille {

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
