#include "svg_layer.h"

#include "subdivision.h"

namespace quadrille {

SvgLayer::SvgLayer(const Layer& layer, double tolerance)
    : layer_(layer), opacity_(patch_opacities(layer.patches, tolerance)) {}

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

}  // namespace quadrille
