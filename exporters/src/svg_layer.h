#pragma once

#include <vector>

#include "paint_groups.h"
#include "patch_opacity.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// A layer in the picture's coordinates, with the order in which its patches are painted: the
/// translucent ones first, so that they can reach under the opaque ones, and the faint ones of them
/// before the others, which can reach over them; all region by region; the transparent ones, and
/// those that is_paintable() refuses, never. The opaque ones of a region are painted part by part,
/// so that the patches along the two sides of a tear are in different parts: those painted later
/// are clipped there, as all are at the outline.
class SvgLayer {
 public:
  /// Alpha within `tolerance` (of 1) of 0 or 1 counts as such; the picture is the rectangle [0,
  /// width] x [0, height]. Keeps a reference to the layer.
  SvgLayer(const Layer& layer, double tolerance, double width, double height);

  const Layer& layer() const { return layer_; }
  const QuadMesh& mesh() const { return layer_.patches.mesh; }
  BicubicHermite<Eigen::Vector2d> geometry(int quad) const;
  BicubicHermite<Color> color(int quad) const;
  /// True when half-edge h is on the border of the mesh or of a patch that cannot be painted.
  bool is_border(int h) const {
    return mesh().twin(h) < 0 || !paintable_[QuadMesh::quad_of(mesh().twin(h))];
  }
  /// True when the patch on the other side of half-edge h is painted after the one of h.
  bool is_painted_later(int h) const;
  /// True when `other` is painted after `quad`.
  bool is_painted_later(int quad, int other) const;
  /// True when the colours of a translucent patch count for little beside those of another, which
  /// may then reach over them: few pixels at the tear between the two show a mixture.
  bool is_outshone(int quad, int other) const { return faint_[quad] && !faint_[other]; }
  /// Number of the smooth region of a quad: quads that only tears separate are of different ones.
  int region(int quad) const { return region_[quad]; }
  /// Number of the part of an opaque quad; parts of a region follow each other.
  int part(int quad) const { return parts_.group[quad]; }
  /// True when a clip ends the part of half-edge h there; its patches go on beyond.
  bool is_clipped(int h) const { return across(mesh(), parts_, h) == Across::outside; }
  /// True when the paint of half-edge h's patch ends there for all to see: at a clip, or at a tear
  /// over what is painted earlier.
  bool is_cut(int h) const {
    return is_clipped(h) || (mesh().is_tear(mesh().edge(h)) && !is_painted_later(h));
  }
  /// What clips a part; empty when nothing does.
  std::vector<EdgeLoop> clip(int part) const { return group_region(mesh(), parts_, part); }
  PatchOpacity opacity(int quad) const { return opacity_[quad]; }
  bool is_opaque(int quad) const { return opacity(quad) == PatchOpacity::opaque; }
  /// Quads of this opacity in painting order.
  std::vector<int> quads(PatchOpacity opacity) const;
  /// Number of the tile of a quad that is painted. Tiles are compact, follow each other in painting
  /// order, and lie within a part or region.
  int tile(int quad) const { return tile_[quad]; }

 private:
  void number_parts(double width, double height);
  void number_tiles();

  const Layer& layer_;
  std::vector<char> paintable_;
  std::vector<PatchOpacity> opacity_;
  std::vector<char> faint_;
  std::vector<int> region_;
  PaintGroups parts_;      ///< of the opaque quads
  std::vector<int> tile_;  ///< numbers rise with those of parts and regions
};

}  // namespace quadrille
