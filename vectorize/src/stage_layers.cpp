#include "quadrille/stage_layers.h"

#include "field_layers.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/picture_layers.h"
#include "scene_parts.h"

namespace quadrille {
namespace {

SceneLayer chain_layer(const ChainNetwork& network) {
  SceneShapes shapes;
  shapes.cell = SceneShapes::Cell::line;
  std::vector<float> contrast, sharpness, length, gain;
  for (const FeatureChain& chain : network.chains) {
    for (const Eigen::Vector2d& p : chain.points) {
      shapes.cell_points.push_back(static_cast<int>(shapes.points.size()));
      shapes.points.push_back(p);
    }
    shapes.end_cell();
    contrast.push_back(static_cast<float>(chain.contrast));
    sharpness.push_back(static_cast<float>(chain.sharpness));
    length.push_back(static_cast<float>(chain.length));
    gain.push_back(static_cast<float>(chain.gain));
  }
  shapes.cell_arrays = {
      number_array("contrast", "mean distance of the colours on both sides, sRGB and alpha 0 to 1",
                   std::move(contrast)),
      number_array("sharpness", "share of the contrast within a pixel on either side, 0 to 1",
                   std::move(sharpness)),
      number_array("length", "source pixels", std::move(length)),
      number_array("gain", "what following the chain was worth, for comparison only",
                   std::move(gain))};
  SceneLayer layer{"feature-chains", "the sharp edges of the picture that the mesh follows"};
  layer.style.ink = kRed;
  layer.style.width = 2;
  layer.content = std::move(shapes);
  return layer;
}

std::vector<SceneLayer> quad_layers(const Quadrangulation& stages, double) {
  std::vector<SceneLayer> layers = {quad_layer(stages.mesh)};
  if (!stages.chains.chains.empty()) layers.push_back(chain_layer(stages.chains));
  layers.push_back(irregular_vertex_layer(stages.mesh));
  return layers;
}

std::vector<SceneLayer> patch_layers(const Quadrangulation& stages, double) {
  PatchMesh patches = straight_patches(stages.mesh);
  set_bessel_tangents(patches);
  guard_folds(patches);
  const VectorImage image = single_layer(std::move(patches), 0, 0);
  return {edge_layer(image), irregular_vertex_layer(stages.mesh)};
}

}  // namespace

const std::vector<SceneStage>& scene_stages() {
  static const std::vector<SceneStage> stages = {
      {"feature", "feature weight in red, feature lines dark", true, feature_layers},
      {"cross-field",
       "crosses; singularities red (+1/4) and blue (-1/4), rings where one was cancelled", true,
       cross_field_layers},
      {"scale",
       "edge length from violet (short) to yellow (long); crosses show both lengths and directions",
       true, scale_layers},
      {"position", "the lattice point of every working pixel", true, position_layers},
      {"quads", "the mesh; vertices of valence 3 or less red, 5 or more blue", false, quad_layers},
      {"patches", "the curved edges of the patches", false, patch_layers},
  };
  return stages;
}

bool can_show(const SceneStage& stage, const Quadrangulation& stages) {
  return !stage.needs_fields || !stages.cross.z.data.empty();
}

}  // namespace quadrille
