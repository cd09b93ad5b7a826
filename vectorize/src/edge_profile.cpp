#include "edge_profile.h"

#include <array>
#include <cmath>

namespace quadrille {

EdgeProfile edge_profile(const PremultipliedColours& colours, const Eigen::Vector2d& point,
                         const Eigen::Vector2d& normal) {
  constexpr int kReach = 10;         // samples on either side
  constexpr int kPerPixel = 4;       // samples
  constexpr int kLeast = kPerPixel;  // nearest place of a side
  constexpr double kEnough = 0.95;   // of the largest contrast
  constexpr int kStep = 2;           // samples over which the contrast still grows ...
  constexpr double kGrowth = 1.05;   // ... by at least this factor
  using Colour = PremultipliedColours::Colour;
  std::array<Colour, 2 * kReach + 1> line;
  for (int i = -kReach; i <= kReach; ++i) {
    line[i + kReach] = colours.at(point + normal * (static_cast<double>(i) / kPerPixel));
  }
  const auto contrast = [&](int r) -> double {
    return (line[kReach + r] - line[kReach - r]).norm();
  };
  EdgeProfile profile;
  for (int r = kLeast; r <= kReach; ++r) {
    profile.contrast = std::max(profile.contrast, contrast(r));
    if (r - kStep >= kLeast && contrast(r) <= kGrowth * contrast(r - kStep)) break;
  }
  if (!(profile.contrast > 0)) return profile;
  int reach = kLeast;
  while (contrast(reach) < kEnough * profile.contrast) ++reach;

  const Colour low = line[kReach - reach], jump = line[kReach + reach] - low;
  double filled = 0;  // integral of the share of the far side
  for (int i = -reach; i <= reach; ++i) {
    const double share = (line[kReach + i] - low).dot(jump) / jump.squaredNorm();
    filled += std::clamp(share, 0.0, 1.0) * (std::abs(i) == reach ? 0.5 : 1);
  }
  profile.offset = (reach - filled) / kPerPixel;
  // About the edge rather than the point.
  const Eigen::Vector2d edge = point + profile.offset * normal;
  const double within = (colours.at(edge + normal) - colours.at(edge - normal)).norm();
  profile.sharpness = std::min(1.0, within / profile.contrast);
  return profile;
}

}  // namespace quadrille
