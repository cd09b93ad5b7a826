#include "quadrille/scene_window.h"

#include <algorithm>
#include <cmath>

namespace quadrille {

int curve_segments(const std::array<Eigen::Vector2d, 4>& control, double tolerance) {
  constexpr double kMost = 4096;
  const auto& [a, b, c, d] = control;
  const double bend = std::max((a - 2 * b + c).norm(), (b - 2 * c + d).norm());
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(0.75 * bend / tolerance)), 1.0, kMost));
}

}  // namespace quadrille
