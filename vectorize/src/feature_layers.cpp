#include <algorithm>
#include <cmath>
#include <complex>

#include "field_layers.h"
#include "scene_parts.h"

namespace quadrille {

std::vector<SceneLayer> feature_layers(const Quadrangulation& stages, double) {
  constexpr double kEdgeStrength = 0.9, kWeightStrength = 0.75;  // of the tint
  const FeatureTensor& features = stages.features;
  SceneGrid grid = grid_of(features.weight, stages.working);
  VectorArray gradient, direction;
  std::vector<std::uint8_t> tint;
  for (std::size_t i = 0; i < features.weight.data.size(); ++i) {
    gradient.add(features.gradient.data[i].cast<double>());
    const std::complex<float> z = features.direction.data[i];
    const double angle = 0.25 * std::arg(z);
    direction.add(std::abs(z) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    const bool on_line = features.edges.data[i] != 0;
    const double weight = std::clamp<double>(features.weight.data[i], 0, 1);
    const double strength = on_line ? kEdgeStrength : kWeightStrength * weight;
    add_bytes(tint, on_line ? kDark : kRed);
    tint.push_back(static_cast<std::uint8_t>(std::lround(255 * strength)));
  }
  grid.arrays = {
      number_array("weight", "how much the direction matters, 0 to 1", features.weight.data),
      number_array("edge", "1 on thinned feature lines", features.edges.data),
      gradient.finish("gradient", "colour gradient, sRGB units (0 to 1) per working pixel"),
      direction.finish("direction", "along or across the feature, 0 where the picture is flat"),
      color_array("rgba", "tint: weight in red, feature lines dark", 4, std::move(tint))};
  SceneLayer layer{"feature-strength", "feature weight in red, feature lines dark"};
  layer.style.colors = "rgba";
  layer.content = std::move(grid);
  return {std::move(layer)};
}

}  // namespace quadrille
