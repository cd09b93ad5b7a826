#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "block_colors.h"
#include "layer_scene.h"
#include "patch_inverse.h"
#include "point_shader.h"

namespace quadrille {

/// Colours of one patch at points of a scene's samples. What a point gets depends on the patch and
/// the point only, not on the points that are shaded along with it.
class PatchShader {
 public:
  PatchShader(const LayerScene& scene, int patch);

  /// See PatchView; the points of batches are relative to it.
  const std::array<int, 2>& origin() const { return view_.origin; }
  bool opaque() const { return scene_.patches().opaque; }

  /// Colours at the batch's points.
  void shade(ColorBatch& batch);

  /// judge_blocks(), find_block_series() and block_matches() of the patch.
  void judge(int side, std::span<const ColorBlock> blocks, std::uint8_t* fit) const;
  bool find_series(int side, const ColorBlock& block, float* series) const;
  bool matches(const ColorBlock& block, const float* series, std::uint64_t samples) const;

 private:
  /// For points whose parameters Newton's method does not find.
  struct Exact {
    FergusonPatch patch;
    PatchInverse inverse;
  };

  const LayerScene& scene_;
  const int patch_;
  const PatchProgram& program_;
  const PatchView& view_;
  std::optional<Exact> exact_;

  void shade_exactly(ColorBatch& batch, int i);
};

}  // namespace quadrille
