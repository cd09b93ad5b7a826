#include "svg_layer.h"

#include <algorithm>

#include "quadrille/mesh_region.h"
#include "subdivision.h"

namespace quadrille {
namespace {

/// Farther from the origin, in pixels, nothing is painted.
constexpr double kFarthest = 1e7;

bool can_be_painted(const BicubicHermite<Eigen::Vector2d>& position,
                    const BicubicHermite<Color>& color) {
  const auto is_near = [](const Eigen::Vector2d& p) {  // false for what is not finite
    return (p.array().abs() < kFarthest).all();
  };
  const auto is_finite = [](const Color& c) { return c.allFinite(); };
  const auto all = [](const auto& patch, const auto& holds) {
    for (int k = 0; k < 4; ++k) {
      if (!holds(patch.value[k]) || !holds(patch.du[k]) || !holds(patch.dv[k]) ||
          !holds(patch.duv[k])) {
        return false;
      }
    }
    return true;
  };
  return all(position, is_near) && all(color, is_finite);
}

}  // namespace

SvgLayer::SvgLayer(const Layer& layer, double tolerance)
    : layer_(layer),
      opacity_(patch_opacities(layer.patches, tolerance)),
      region_(smooth_regions(layer.patches.mesh)) {
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (!can_be_painted(geometry(q), color(q))) opacity_[q] = PatchOpacity::transparent;
  }
}

std::vector<int> SvgLayer::quads(PatchOpacity opacity) const {
  std::vector<int> list = patches_with(opacity_, opacity);
  std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return region_[a] < region_[b]; });
  return list;
}

BicubicHermite<Eigen::Vector2d> SvgLayer::geometry(int quad) const {
  return placed_geometry(layer_, quad);
}

BicubicHermite<Color> SvgLayer::color(int quad) const {
  return ferguson_patch(layer_.patches, quad).color;
}

bool SvgLayer::is_painted_later(int h) const {
  const int twin = mesh().twin(h);
  return twin >= 0 && is_painted_later(QuadMesh::quad_of(h), QuadMesh::quad_of(twin));
}

bool SvgLayer::is_painted_later(int quad, int other) const {
  const PatchOpacity mine = opacity_[quad], its = opacity_[other];
  if (its == PatchOpacity::transparent) return false;
  if (mine == its && region_[quad] != region_[other]) return region_[other] > region_[quad];
  return mine == its ? other > quad : its == PatchOpacity::opaque;
}

}  // namespace quadrille
