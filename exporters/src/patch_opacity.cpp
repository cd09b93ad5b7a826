#include "patch_opacity.h"

#include <algorithm>

namespace quadrille {
namespace {

PatchOpacity opacity_of(const BicubicHermite<Color>& color, double tolerance) {
  constexpr int kSteps = 8;
  float low = 1, high = 0;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const float alpha = color.at(double(i) / kSteps, double(j) / kSteps)[3];
      low = std::min(low, alpha);
      high = std::max(high, alpha);
    }
  }
  if (low >= 1 - tolerance) return PatchOpacity::opaque;
  return high <= tolerance ? PatchOpacity::transparent : PatchOpacity::translucent;
}

}  // namespace

std::vector<PatchOpacity> patch_opacities(const PatchMesh& patches, double tolerance) {
  std::vector<PatchOpacity> opacities(patches.patch_count(), PatchOpacity::opaque);
  if (patches.opaque) return opacities;
  for (int q = 0; q < patches.patch_count(); ++q) {
    opacities[q] = opacity_of(ferguson_patch(patches, q).color, tolerance);
  }
  return opacities;
}

std::vector<PatchOpacity> paint_opacities(const PatchMesh& patches, double tolerance,
                                          const std::vector<char>& paintable) {
  std::vector<PatchOpacity> opacities = patch_opacities(patches, tolerance);
  for (int q = 0; q < patches.patch_count(); ++q) {
    if (!paintable[q]) opacities[q] = PatchOpacity::transparent;
  }
  return opacities;
}

std::vector<int> patches_with(const std::vector<PatchOpacity>& opacities, PatchOpacity wanted) {
  std::vector<int> list;
  for (std::size_t q = 0; q < opacities.size(); ++q) {
    if (opacities[q] == wanted) list.push_back(static_cast<int>(q));
  }
  return list;
}

}  // namespace quadrille
