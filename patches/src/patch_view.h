#pragma once

#include <Eigen/Geometry>
#include <array>

#include "patch_program.h"

namespace quadrille {

/// How a patch lies in a scene's samples.
struct PatchView {
  /// A whole sample position near the patch; points are given relative to it, see ColorBatch.
  std::array<int, 2> origin = {0, 0};
  /// Takes points to the program's normalized ones: x = map[0] x + map[1] y + map[2].
  float map[6] = {};
  bool known = false;

  PatchView() = default;
  PatchView(const PatchProgram& program, const Eigen::Affine2d& to_samples,
            const Eigen::Affine2d& from_samples);
};

}  // namespace quadrille
