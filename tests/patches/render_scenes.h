#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "quadrille/render.h"
#include "support/random_patches.h"

namespace quadrille::testing {

inline VectorImage random_image(std::uint32_t seed, bool opaque = true) {
  PatchMesh patches = random_patches(6, 5, 37, 29, seed, {0.25, 0.8});
  set_random_colors(patches, seed + 100, opaque);
  return single_layer(std::move(patches), 37, 29);
}

/// Opaque, with colours far below 0 and above 1, where they are drawn cut off.
inline VectorImage overshooting_image(std::uint32_t seed) {
  VectorImage image = random_image(seed);
  for (Wedge& w : image.layers[0].patches.wedges) {
    for (int k = 0; k < 3; ++k) {
      w.value[k] = 0.5f + 3 * (w.value[k] - 0.5f);
      w.dx[k] *= 3, w.dy[k] *= 3, w.twist[k] *= 3;
    }
  }
  return image;
}

/// A picture of width x height with a rectangle of one colour (premultiplied) in it.
inline Layer rectangle(double x, double y, double width, double height, const Color& color) {
  Layer layer;
  layer.patches = straight_patches(lattice(3, 2, width, height));
  set_linear_colors(layer.patches, color);
  layer.transform.translate(Eigen::Vector2d(x, y));
  return layer;
}

inline VectorImage picture_of(std::vector<Layer> layers, double width, double height) {
  VectorImage image;
  image.width = width;
  image.height = height;
  image.layers = std::move(layers);
  return image;
}

inline RenderOptions at_scale(double scale) {
  RenderOptions options;
  options.scale = scale;
  return options;
}

}  // namespace quadrille::testing
