#include "patch_shader.h"

#include <algorithm>

namespace quadrille {

PatchShader::PatchShader(const LayerScene& scene, int patch)
    : scene_(scene), patch_(patch), program_(scene.program(patch)), view_(scene.view(patch)) {}

void PatchShader::shade(ColorBatch& batch) {
  if (program_.regular) {
    invert_points(program_, view_.map, batch);
    shade_parameters(program_, scene_.patches().opaque, batch);
    for (int k = 0; k < batch.missing_count; ++k) shade_exactly(batch, batch.missing[k]);
  } else {
    for (int i = 0; i < batch.count; ++i) shade_exactly(batch, i);
  }
}

void PatchShader::judge(int side, std::span<const ColorBlock> blocks, std::uint8_t* fit) const {
  std::fill(fit, fit + blocks.size(), std::uint8_t{0});
  if (program_.regular) {
    judge_blocks(program_, view_.map, scene_.patches().opaque, side, blocks, fit);
  }
}

bool PatchShader::find_series(int side, const ColorBlock& block, float* series) const {
  if (!program_.regular) return false;
  return find_block_series(program_, view_.map, scene_.patches().opaque, side, block, series);
}

bool PatchShader::matches(const ColorBlock& block, const float* series,
                          std::uint64_t samples) const {
  return block_matches(program_, view_.map, opaque(), block, series, samples);
}

void PatchShader::shade_exactly(ColorBatch& batch, int i) {
  if (!exact_) {
    const FergusonPatch patch = ferguson_patch(scene_.patches(), patch_);
    exact_.emplace(Exact{patch, PatchInverse(patch.position)});
  }
  const Eigen::Vector2d point(batch.x[i] + view_.origin[0], batch.y[i] + view_.origin[1]);
  const Eigen::Vector2d at = exact_->inverse(scene_.from_samples() * point);
  const Color color = exact_->patch.color.at(at.x(), at.y());
  float alpha = 1;
  if (!scene_.patches().opaque) batch.color[3][i] = alpha = std::clamp(color[3], 0.0f, 1.0f);
  for (int k = 0; k < 3; ++k) batch.color[k][i] = std::clamp(color[k], 0.0f, alpha);
}

}  // namespace quadrille
