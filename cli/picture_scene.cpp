#include "picture_scene.h"

#include <algorithm>
#include <cmath>

#include "quadrille/picture_layers.h"
#include "quadrille/stage_layers.h"

namespace quadrille::cli {

double readable_scale(double width, double height) {
  constexpr double kWishedSide = 1600;
  return std::clamp(std::round(kWishedSide / std::max(width, height)), 1.0, 8.0);
}

Scene scene_of(const VectorImage& image, const Origin& origin, const RunContext& context) {
  // The layers share the image; here it outlives them.
  const std::shared_ptr<const VectorImage> shared(std::shared_ptr<void>(), &image);
  Scene scene{image.width, image.height, {picture_group(shared, origin.picture, context)}};
  if (!origin.stages) return scene;
  const double drawing_pixel = 1 / readable_scale(image.width, image.height);
  for (const SceneStage& stage : scene_stages()) {
    if (!can_show(stage, *origin.stages)) continue;
    scene.groups.push_back(
        {stage.name, stage.summary, stage.layers(*origin.stages, drawing_pixel)});
  }
  return scene;
}

}  // namespace quadrille::cli
