#include "svg_layer.h"

#include <algorithm>

#include "subdivision.h"

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

SvgLayer::SvgLayer(const Layer& layer, double tolerance) : layer_(layer) {
  opacity_.assign(mesh().quad_count(), PatchOpacity::opaque);
  if (layer.patches.opaque) return;
  for (int q = 0; q < mesh().quad_count(); ++q) opacity_[q] = opacity_of(color(q), tolerance);
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
  return mine == its ? other > quad : its == PatchOpacity::opaque;
}

std::vector<int> SvgLayer::quads(PatchOpacity opacity) const {
  std::vector<int> list;
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (opacity_[q] == opacity) list.push_back(q);
  }
  return list;
}

}  // namespace quadrille
