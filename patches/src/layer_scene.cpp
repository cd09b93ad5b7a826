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

int floor_block(int sample) {
  return sample >= 0 ? sample / kBlockSide : -((kBlockSide - 1 - sample) / kBlockSide);
}

}  // namespace

LayerScene::LayerScene(const Layer& layer, const std::array<double, 2>& scale,
                       const SampleWindow& window)
    : layer_(layer),
      to_samples_(sample_map(layer, scale)),
      from_samples_(to_samples_.inverse()),
      wanted_(patches_in_window(layer.patches, to_samples_, window)),
      scan_(layer.patches, to_samples_, wanted_),
      blocks_{floor_block(window.x_begin), floor_block(window.y_begin),
              floor_block(window.x_end - 1) + 1, floor_block(window.y_end - 1) + 1} {
  const std::size_t columns = blocks_.x_end - blocks_.x_begin;
  const std::size_t rows = blocks_.y_end - blocks_.y_begin;
  const auto for_each_block = [&](const auto& visit) {
    for (const int q : wanted_) {
      const SampleWindow b = blocks_of(q);
      for (int y = b.y_begin; y < b.y_end; ++y) {
        for (int x = b.x_begin; x < b.x_end; ++x) {
          visit(q, (y - blocks_.y_begin) * columns + (x - blocks_.x_begin));
        }
      }
    }
  };
  bin_begin_.assign(columns * rows + 1, 0);
  for_each_block([&](int, std::size_t block) { ++bin_begin_[block + 1]; });
  for (std::size_t b = 0; b < columns * rows; ++b) bin_begin_[b + 1] += bin_begin_[b];
  bins_.resize(bin_begin_.back());
  std::vector<std::size_t> next(bin_begin_.begin(), bin_begin_.end() - 1);
  for_each_block([&](int q, std::size_t block) { bins_[next[block]++] = q; });
}

SampleWindow LayerScene::blocks_of(int patch) const {
  const SampleWindow s = scan_.touched(patch);
  return intersection({floor_block(s.x_begin), floor_block(s.y_begin), floor_block(s.x_end) + 1,
                       floor_block(s.y_end) + 1},
                      blocks_);
}

std::span<const int> LayerScene::patches_at(const SampleWindow& part) const {
  const std::size_t columns = blocks_.x_end - blocks_.x_begin;
  const std::size_t block = (floor_block(part.y_begin) - blocks_.y_begin) * columns +
                            (floor_block(part.x_begin) - blocks_.x_begin);
  return {bins_.data() + bin_begin_[block], bins_.data() + bin_begin_[block + 1]};
}

}  // namespace quadrille
