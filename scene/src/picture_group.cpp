#include <utility>

#include "quadrille/picture_layers.h"
#include "quadrille/render.h"

namespace quadrille {

SceneLayer patch_layer(std::shared_ptr<const VectorImage> image, std::vector<float> errors) {
  SceneLayer layer{"patches", "the bicubic patches with their colours"};
  layer.content = ScenePatches{std::move(image), std::move(errors)};
  return layer;
}

SceneGroup picture_group(std::shared_ptr<const VectorImage> image, const Raster* source,
                         const RunContext& context) {
  SceneGroup group{"picture", "the picture as patches"};
  std::vector<float> errors;
  if (source) {
    group.layers.push_back(raster_layer(*source));
    group.layers.push_back(error_layer(*source, render(*image, {}, context)));
    errors = patch_errors(*image, std::get<SceneGrid>(group.layers.back().content));
  }
  group.layers.push_back(patch_layer(image, std::move(errors)));
  group.layers.push_back(surface_layer(*image, 4, context));
  group.layers.push_back(control_net_layer(*image));
  group.layers.push_back(edge_layer(*image));
  group.layers.push_back(tear_layer(*image));
  group.layers.push_back(irregular_vertex_layer(*image));
  return group;
}

}  // namespace quadrille
