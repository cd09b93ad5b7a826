#include "paintable_patch.h"

namespace quadrille {

bool is_paintable(const BicubicBezier<Eigen::Vector2d>& position,
                  const BicubicBezier<Color>& color) {
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      // Written so that it is false for what is not a number.
      const bool is_near = (position.control[j][i].array().abs() < kFarthestPixel).all();
      if (!is_near || !color.control[j][i].allFinite()) return false;
    }
  }
  return true;
}

bool is_paintable(const Layer& layer, int quad) {
  return is_paintable(to_bezier(placed_geometry(layer, quad)),
                      to_bezier(ferguson_patch(layer.patches, quad).color));
}

std::vector<char> paintable_patches(const Layer& layer) {
  std::vector<char> paintable(layer.patches.patch_count());
  for (std::size_t q = 0; q < paintable.size(); ++q) {
    paintable[q] = is_paintable(layer, static_cast<int>(q));
  }
  return paintable;
}

}  // namespace quadrille
