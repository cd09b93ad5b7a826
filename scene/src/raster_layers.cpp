#include <algorithm>
#include <cmath>
#include <utility>

#include "layer_parts.h"
#include "quadrille/error.h"
#include "quadrille/picture_layers.h"

namespace quadrille {
namespace {

constexpr float kFullRed = 32;  // error, of 255, that is drawn in full red
constexpr int kSamples = 8;     // of a patch per parameter direction

SceneGrid grid_over(const Raster& picture) {
  SceneGrid grid;
  grid.width = picture.width;
  grid.height = picture.height;
  return grid;
}

/// Channel c of a pixel, premultiplied; alpha is 1 where the picture has none.
float premultiplied(const Raster& picture, int x, int y, int c) {
  const float* p = picture.pixel(x, y);
  const float alpha = picture.has_alpha() ? p[3] : 1.0f;
  return c == 3 ? alpha : p[c] * alpha;
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(255 * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

/// Root of the area-weighted mean square of the grid's values at points of a patch.
float mean_over(const BicubicHermite<Eigen::Vector2d>& position, const Eigen::Affine2d& transform,
                const SceneGrid& grid, const std::vector<float>& values) {
  double sum = 0, weights = 0;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const double u = (i + 0.5) / kSamples, v = (j + 0.5) / kSamples;
      const Eigen::Vector2d p = transform * position.at(u, v);
      const double x = std::floor(p.x() / grid.pixel_width),
                   y = std::floor(p.y() / grid.pixel_height);
      if (!(x >= 0 && y >= 0 && x < grid.width && y < grid.height)) continue;
      const Eigen::Vector2d du = position.derivative_u(u, v), dv = position.derivative_v(u, v);
      const double weight = std::abs(du.x() * dv.y() - du.y() * dv.x());
      const double value =
          values[static_cast<std::size_t>(y) * grid.width + static_cast<std::size_t>(x)];
      sum += weight * value * value;
      weights += weight;
    }
  }
  return weights > 0 ? static_cast<float>(std::sqrt(sum / weights)) : 0.0f;
}

}  // namespace

SceneLayer raster_layer(const Raster& picture) {
  std::vector<std::uint8_t> bytes(picture.data.size());
  std::ranges::transform(picture.data, bytes.begin(), to_byte);
  const std::string name = picture.has_alpha() ? "rgba" : "rgb";
  SceneGrid grid = grid_over(picture);
  grid.arrays.push_back(scene_array(name, "straight sRGB bytes", std::move(bytes), picture.channels,
                                    SceneArray::Kind::color));
  SceneLayer layer{"picture", "the source picture"};
  layer.style.colors = name;
  layer.content = std::move(grid);
  return layer;
}

SceneLayer error_layer(const Raster& source, const Raster& drawn) {
  if (source.width != drawn.width || source.height != drawn.height) {
    throw Error(ErrorCode::invalid_argument,
                "pictures of different sizes have no difference; draw at the source's size");
  }
  const int channels = source.has_alpha() || drawn.has_alpha() ? 4 : 3;
  std::vector<float> difference, error;
  std::vector<std::uint8_t> color;
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      float sum = 0;
      for (int c = 0; c < channels; ++c) {
        const float d = 255 * (premultiplied(drawn, x, y, c) - premultiplied(source, x, y, c));
        difference.push_back(d);
        sum += d * d;
      }
      error.push_back(std::sqrt(sum / channels));
      const std::uint8_t fading = to_byte(1 - error.back() / kFullRed);
      color.insert(color.end(), {255, fading, fading});
    }
  }
  SceneGrid grid = grid_over(source);
  grid.arrays = {
      scene_array("error", "root mean square of the difference over the channels, 0 to 255",
                  std::move(error)),
      scene_array("difference", "drawn minus source, premultiplied, -255 to 255",
                  std::move(difference), channels),
      scene_array("rgb", "from white, no error, to red, 32 of 255 or more", std::move(color), 3,
                  SceneArray::Kind::color)};
  SceneLayer layer{"error", "where the drawn patches differ from the source"};
  layer.style.colors = "rgb";
  layer.content = std::move(grid);
  return layer;
}

std::vector<float> patch_errors(const VectorImage& image, const SceneGrid& error) {
  const auto array = std::ranges::find(error.arrays, "error", &SceneArray::name);
  if (array == error.arrays.end()) {
    throw Error(ErrorCode::invalid_argument, "the grid has no array \"error\"; see error_layer()");
  }
  const auto& values = std::get<std::vector<float>>(array->values);
  std::vector<float> errors;
  for (const Layer& layer : image.layers) {
    for (int q = 0; q < layer.patches.patch_count(); ++q) {
      errors.push_back(mean_over(patch_geometry(layer.patches, q), layer.transform, error, values));
    }
  }
  return errors;
}

}  // namespace quadrille
