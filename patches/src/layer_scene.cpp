#include "layer_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

Eigen::Affine2d sample_map(const Layer& layer, const std::array<double, 2>& scale) {
  if (!layer.transform.matrix().allFinite()) {
    throw Error(ErrorCode::invalid_argument, "the transform of layer '" + layer.name +
                                                 "' is not finite; give it finite numbers");
  }
  return Eigen::Scaling(scale[0], scale[1]) * layer.transform;
}

/// Patches whose control points' bounding box meets the window. A map without an inverse leaves
/// nothing to see.
std::vector<int> patches_in_window(const PatchMesh& patches, const Eigen::Affine2d& to_samples,
                                   const SampleWindow& window) {
  std::vector<int> found;
  if (to_samples.linear().determinant() == 0) return found;
  const Eigen::Array2d window_low(window.x_begin, window.y_begin);
  const Eigen::Array2d window_high(window.x_end, window.y_end);
  for (int q = 0; q < patches.patch_count(); ++q) {
    Eigen::Array2d low(INFINITY, INFINITY), high = -low;
    for (int k = 0; k < 4; ++k) {
      const int h = 4 * q + k;
      const Eigen::Vector2d ends[2] = {patches.mesh.vertices[patches.mesh.origin(h)],
                                       patches.mesh.vertices[patches.mesh.tip(h)]};
      const Eigen::Array2d control[3] = {to_samples * ends[0],
                                         to_samples * (ends[0] + tangent_along(patches, h, 0) / 3),
                                         to_samples * (ends[1] - tangent_along(patches, h, 1) / 3)};
      for (const Eigen::Array2d& p : control) low = low.min(p), high = high.max(p);
    }
    // Written so that numbers that are not finite stay in and are reported.
    const bool outside = (high < window_low - 1).any() || (low > window_high + 1).any();
    if (!outside) found.push_back(q);
  }
  return found;
}

}  // namespace

LayerScene::LayerScene(const Layer& layer, const std::array<double, 2>& scale,
                       const SampleWindow& window)
    : layer_(layer),
      to_samples_(sample_map(layer, scale)),
      from_samples_(to_samples_.inverse()),
      wanted_(patches_in_window(layer.patches, to_samples_, window)),
      scan_(layer.patches, to_samples_, wanted_),
      bins_(scan_, wanted_, window) {}

}  // namespace quadrille
