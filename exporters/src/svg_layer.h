#pragma once

#include <vector>

#include "patch_opacity.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// A layer in the picture's coordinates, with the order in which its patches are painted: the
/// translucent ones first, so that they can reach under the opaque ones, both region by region; the
/// transparent ones, and those with coordinates or colours that are not finite, never.
class SvgLayer {
 public:
  /// Alpha within `tolerance` (of 1) of 0 or 1 counts as such. Keeps a reference to the layer.
  SvgLayer(const Layer& layer, double tolerance);

  const QuadMesh& mesh() const { return layer_.patches.mesh; }
  BicubicHermite<Eigen::Vector2d> geometry(int quad) const;
  BicubicHermite<Color> color(int quad) const;
  /// True when the patch on the other side of half-edge h is painted after the one of h.
  bool is_painted_later(int h) const;
  /// True when `other` is painted after `quad`.
  bool is_painted_later(int quad, int other) const;
  /// Number of the smooth region of a quad: quads that only tears separate are of different ones.
  int region(int quad) const { return region_[quad]; }
  PatchOpacity opacity(int quad) const { return opacity_[quad]; }
  bool is_opaque(int quad) const { return opacity(quad) == PatchOpacity::opaque; }
  /// Quads of this opacity in painting order.
  std::vector<int> quads(PatchOpacity opacity) const;

 private:
  const Layer& layer_;
  std::vector<PatchOpacity> opacity_;
  std::vector<int> region_;
};

}  // namespace quadrille
