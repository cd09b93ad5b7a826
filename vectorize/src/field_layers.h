#pragma once

#include <vector>

#include "quadrille/scene_layer.h"
#include "quadrille/vectorize.h"

namespace quadrille {

/// The layers of the stages "feature", "cross-field", "scale" and "position"; see scene_stages().
std::vector<SceneLayer> feature_layers(const Quadrangulation& stages, double drawing_pixel);
std::vector<SceneLayer> cross_field_layers(const Quadrangulation& stages, double drawing_pixel);
std::vector<SceneLayer> scale_layers(const Quadrangulation& stages, double drawing_pixel);
std::vector<SceneLayer> position_layers(const Quadrangulation& stages, double drawing_pixel);

}  // namespace quadrille
