#include "pdf_underlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrille {
namespace {

/// Means of colours per pixel.
class Canvas {
 public:
  Canvas(const Eigen::AlignedBox2d& box, int pixels) : box_(box) {
    const Eigen::Vector2d size = box.sizes();
    const double side = std::sqrt(size.x() * size.y() / pixels);
    const auto count = [&](double length) {
      return static_cast<int>(std::clamp(std::ceil(length / side), 1.0, double(pixels)));
    };
    width_ = count(size.x());
    height_ = count(size.y());
    sums_.resize(std::size_t(width_) * height_);
  }

  int width() const { return width_; }
  int height() const { return height_; }

  void add(const Eigen::Vector2d& position, const std::array<float, 3>& color) {
    const Eigen::Vector2d part =
        (position - box_.min()).cwiseQuotient(box_.sizes()).cwiseMax(0).cwiseMin(1);
    const int x = std::min(static_cast<int>(part.x() * width_), width_ - 1);
    const int y = std::min(static_cast<int>(part.y() * height_), height_ - 1);
    Sum& sum = sums_[std::size_t(y) * width_ + x];
    for (int c = 0; c < 3; ++c) sum[c] += color[c];
    sum[3] += 1;
  }

  /// Pixels without a colour take the one before in their row; rows without any, the one above.
  std::string bytes() {
    const auto copy_missing = [&](std::size_t to, std::size_t from) {
      if (sums_[to][3] == 0) sums_[to] = sums_[from];
    };
    const std::size_t w = width_, h = height_;
    for (std::size_t y = 0; y < h; ++y) {
      for (std::size_t x = 1; x < w; ++x) copy_missing(y * w + x, y * w + x - 1);
      for (std::size_t x = w; --x > 0;) copy_missing(y * w + x - 1, y * w + x);
    }
    for (std::size_t i = w; i < w * h; ++i) copy_missing(i, i - w);
    for (std::size_t i = w * h; i-- > w;) copy_missing(i - w, i);
    std::string rgb;
    for (const Sum& sum : sums_) {
      for (int c = 0; c < 3; ++c) rgb += static_cast<char>(std::lround(sum[c] / sum[3]));
    }
    return rgb;
  }

 private:
  using Sum = std::array<float, 4>;  ///< of the colours, and their count

  Eigen::AlignedBox2d box_;
  int width_, height_;
  std::vector<Sum> sums_;
};

}  // namespace

Underlay underlay(const Layer& layer, const PaintGroups& groups, const CellTable& cells,
                  const Eigen::AlignedBox2d& box) {
  std::vector<int> quads;
  int pixels = 0;
  for (int q = 0; q < layer.patches.patch_count(); ++q) {
    if (groups.paints(q)) quads.push_back(q);
    pixels += cells.count(q).u > 0;
  }
  if (quads.empty() || !(box.volume() > 0)) return {};
  Canvas canvas(box, pixels);
  for (const int q : quads) {
    const BicubicHermite<Eigen::Vector2d> position = placed_geometry(layer, q);
    const Divisions n = cells.count(q);
    for (int j = 0; j < n.v; ++j) {
      for (int i = 0; i < n.u; ++i) {
        std::array<float, 3> mean{};
        for (int c = 0; c < 3; ++c) {
          mean[c] = 0.25f * float(cells.node(q, i, j)[c] + cells.node(q, i + 1, j)[c] +
                                  cells.node(q, i, j + 1)[c] + cells.node(q, i + 1, j + 1)[c]);
        }
        canvas.add(position.at((i + 0.5) / n.u, (j + 0.5) / n.v), mean);
      }
    }
  }
  return {box, canvas.width(), canvas.height(), canvas.bytes()};
}

}  // namespace quadrille
