#include <algorithm>
#include <array>

#include "sheet_texture.h"

namespace quadrille {
namespace {

/// The unknown texels beside known ones take the mean of those, a few times over: so nothing of
/// what lies beyond a thin gap gets next to what lies before it.
class Grower {
 public:
  Grower(Texture& texture, int first, int count, std::vector<std::uint8_t>& known)
      : texture_(texture), first_(first), count_(count), known_(known) {}

  void grow(int rings) {
    std::vector<std::uint32_t> ring;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (!known_[i] && has_known_neighbour(i)) ring.push_back(static_cast<std::uint32_t>(i));
    }
    for (int k = 0; k < rings && !ring.empty(); ++k) {
      for (const std::uint32_t i : ring) fill(i);
      for (const std::uint32_t i : ring) known_[i] = 1;
      std::vector<std::uint32_t> next;
      for (const std::uint32_t i : ring) {
        for_neighbours(i, [&](std::size_t other) {
          if (!known_[other]) next.push_back(static_cast<std::uint32_t>(other));
        });
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      ring = std::move(next);
    }
  }

 private:
  template <class Visit>
  void for_neighbours(std::size_t texel, const Visit& visit) const {
    const int x = static_cast<int>(texel % texture_.width);
    const int y = static_cast<int>(texel / texture_.width);
    for (int j = std::max(0, y - 1); j <= std::min(texture_.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(texture_.width - 1, x + 1); ++i) {
        visit(std::size_t(j) * texture_.width + i);
      }
    }
  }

  bool has_known_neighbour(std::size_t texel) const {
    bool found = false;
    for_neighbours(texel, [&](std::size_t other) { found |= known_[other] != 0; });
    return found;
  }

  void fill(std::size_t texel) {
    std::array<int, 4> sum{};
    int neighbours = 0;
    for_neighbours(texel, [&](std::size_t other) {
      if (!known_[other]) return;
      ++neighbours;
      for (int c = 0; c < count_; ++c) sum[c] += sample(other, c);
    });
    for (int c = 0; c < count_; ++c) {
      sample(texel, c) = static_cast<std::uint8_t>((sum[c] + neighbours / 2) / neighbours);
    }
  }

  std::uint8_t& sample(std::size_t texel, int c) {
    return texture_.data[texel * texture_.channels + first_ + c];
  }

  Texture& texture_;
  int first_, count_;
  std::vector<std::uint8_t>& known_;
};

void fill_by_halves(Texture& texture, int first, int count,
                    const std::vector<std::uint8_t>& known) {
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
  fill_by_halves(half, first, count, half_known);

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

}  // namespace

std::vector<std::uint8_t> fill_unknown(Texture& texture, int first, int count,
                                       std::vector<std::uint8_t> known) {
  constexpr int kRings = 4;
  if (std::find(known.begin(), known.end(), 0) == known.end()) return known;
  Grower(texture, first, count, known).grow(kRings);
  fill_by_halves(texture, first, count, known);
  return known;
}

}  // namespace quadrille
