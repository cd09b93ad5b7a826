#include "patch_view.h"

#include <cmath>

namespace quadrille {

PatchView::PatchView(const PatchProgram& program, const Eigen::Affine2d& to_samples,
                     const Eigen::Affine2d& from_samples)
    : known(true) {
  const Eigen::Vector2d middle = to_samples * program.center;
  origin = {static_cast<int>(std::floor(middle.x())), static_cast<int>(std::floor(middle.y()))};
  const Eigen::Matrix2d linear = program.to_normalized * from_samples.linear();
  const Eigen::Vector2d offset = linear * (Eigen::Vector2d(origin[0], origin[1]) - middle);
  for (int d = 0; d < 2; ++d) {
    map[3 * d] = static_cast<float>(linear(d, 0));
    map[3 * d + 1] = static_cast<float>(linear(d, 1));
    map[3 * d + 2] = static_cast<float>(offset[d]);
  }
}

}  // namespace quadrille
