#include "gltf_sharpen.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gltf_color.h"

namespace quadrille {
namespace {

/// Between 1/12, which makes up for bilinear interpolation on average, and 1/8, which does for the
/// mean of two by two texels: what a texture of 2 texels a pixel shows at the pixel's centre.
constexpr float kShare = 0.1f;

/// Both ways between 8 bits and linear light.
class Transfer {
 public:
  explicit Transfer(bool is_color) {
    for (int v = 0; v < 256; ++v) linear_[v] = decoded(v / 255.0f, is_color);
    int v = 0;
    for (int i = 0; i <= kFinest; ++i) {
      while (v < 255 && decoded((v + 0.5f) / 255, is_color) < float(i) / kFinest) ++v;
      bytes_[i] = static_cast<std::uint8_t>(v);
    }
  }

  float linear(std::uint8_t value) const { return linear_[value]; }
  std::uint8_t byte(float linear) const {
    return bytes_[std::lround(std::clamp(linear, 0.0f, 1.0f) * kFinest)];
  }

 private:
  static constexpr int kFinest = 1 << 16;
  static float decoded(float value, bool is_color) {
    return is_color ? linear_light(value) : value;
  }

  std::array<float, 256> linear_;
  std::array<std::uint8_t, kFinest + 1> bytes_;
};

}  // namespace

void sharpen_for_filtering(Texture& texture) {
  static const Transfer kColor(true), kAlpha(false);
  const int channels = texture.channels, width = texture.width, height = texture.height;
  const std::size_t row = std::size_t(channels) * width;
  std::vector<std::uint8_t> above(texture.data.begin(), texture.data.begin() + row), here(row);
  for (int y = 0; y < height; ++y) {
    std::uint8_t* const out = texture.data.data() + y * row;
    std::copy_n(out, row, here.begin());
    const std::uint8_t* const below = y + 1 < height ? out + row : here.data();
    for (std::size_t i = 0; i < row; ++i) {
      const std::uint8_t left = here[i < std::size_t(channels) ? i : i - channels];
      const std::uint8_t right = here[i + channels < row ? i + channels : i];
      if (left == here[i] && right == here[i] && above[i] == here[i] && below[i] == here[i]) {
        continue;
      }
      const Transfer& transfer = i % channels == 3 ? kAlpha : kColor;
      const float around = transfer.linear(left) + transfer.linear(right) +
                           transfer.linear(above[i]) + transfer.linear(below[i]);
      const float value = transfer.linear(here[i]);
      out[i] = transfer.byte(value - kShare * (around - 4 * value));
    }
    std::swap(above, here);
  }
}

}  // namespace quadrille
