#pragma once

#include <vector>

#include "subdivision.h"

namespace quadrille {

/// What becomes of patches that is_paintable() refuses.
enum class Unpaintable {
  refuse,  ///< Error{invalid_argument} is thrown
  hide     ///< they are not drawn
};

/// A layer as surfaces under textures see it: Bezier patches in the picture's coordinates, without
/// those that are transparent, and what of their corners and sides is one.
class SheetedLayer {
 public:
  /// Keeps a reference to the layer.
  explicit SheetedLayer(const Layer& layer, Unpaintable unpaintable = Unpaintable::refuse);

  const Layer& layer() const { return layer_; }
  const QuadMesh& mesh() const { return layer_.patches.mesh; }
  const BicubicBezier<Eigen::Vector2d>& position(int quad) const { return position_[quad]; }
  const BicubicBezier<Color>& color(int quad) const { return color_[quad]; }
  /// True when anything of the patch can be seen.
  bool is_drawn(int quad) const { return sheet_[quad] >= 0; }
  /// Per patch; position() and color() of others must not be used.
  const std::vector<char>& paintable() const { return paintable_; }
  bool is_empty() const { return sheet_count_ == 0; }

  /// Patches that a tear separates lie on different sheets, each of which has a texture of its own:
  /// so none of its texels mixes the colours of both sides. -1 for what is not drawn.
  int sheet(int quad) const { return sheet_[quad]; }
  int sheet_count() const { return sheet_count_; }
  /// The drawn patches of other sheets that a tear separates from one of this sheet.
  std::vector<char> torn_off(int sheet) const;

  /// The lowest drawn corner (half-edge 4 quad + k) at the vertex of corner h that has its colour
  /// and its sheet: corners that share one are one vertex of the surface.
  int shared_corner(int h) const { return shared_corner_[h]; }
  /// The same for the sides of patches: the lowest of the half-edges of an edge that are not torn
  /// from each other.
  int shared_side(int h) const;
  /// The drawn corners at the vertex of corner h whose colours differ, one of each, ascending.
  std::vector<int> colors_at(int h) const;
  /// True where the edge of half-edge h has to be drawn sharply: at the outline and along tears.
  bool is_contour(int h) const;
  /// The curve along mesh().halfedge(e): the same for both patches beside it.
  PlaneCurve edge_curve(int e) const;

 private:
  void find_patches(Unpaintable unpaintable);
  void color_sheets();
  void widen_sheets();
  void join_corners();
  std::vector<int> torn_from(int quad) const;

  const Layer& layer_;
  std::vector<BicubicBezier<Eigen::Vector2d>> position_;  // #Q
  std::vector<BicubicBezier<Color>> color_;               // #Q
  std::vector<char> paintable_;                           // #Q
  std::vector<int> sheet_;                                // #Q
  std::vector<int> shared_corner_;                        // #H
  int sheet_count_ = 0;
};

}  // namespace quadrille
