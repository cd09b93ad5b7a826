#pragma once

#include <Eigen/Core>
#include <utility>

#include "svg_bleed.h"
#include "svg_cell_mesh.h"

namespace quadrille {

/// How far the bleed of a group of cells may go on beyond its sides: only over what is painted
/// later. Not for several threads at once.
class BleedReach {
 public:
  /// Keeps references.
  BleedReach(const CellMesh& mesh, const CellGroup& group)
      : mesh_(mesh), layer_(mesh.layer()), group_(group) {}

  /// The step across a side at these parameters on it, of a length of about `bleed` pixels. Where
  /// cells are thin, others that are painted earlier may lie beyond them: unless it is clipped, the
  /// bleed is halved until it ends in a cell that is painted later.
  Eigen::Vector2d step(int side, const Eigen::Vector2d& uv, double bleed, bool is_clipped) const;

  /// True when a step from the origin of half-edge h, into its quad, ends over the group or over
  /// what is painted later.
  bool ends_covered(int h, const Eigen::Vector2d& step) const;

  /// True when a step from a point on the border of a patch or in it crosses a tear around it.
  bool crosses_tear(int quad, const Eigen::Vector2d& from, const Eigen::Vector2d& step) const;

 private:
  using Geometry = BicubicHermite<Eigen::Vector2d>;

  std::pair<int, Eigen::Vector2d> across_border(const CellMesh::Side& side,
                                                const Eigen::Vector2d& uv, int twin,
                                                double bleed) const;
  bool is_covered(int own, int quad, const Eigen::Vector2d& uv) const;
  const Geometry& geometry(int quad) const;

  const CellMesh& mesh_;
  const SvgLayer& layer_;
  const CellGroup& group_;
  mutable int neighbor_ = -1;  ///< the patch of other cells that was asked for last
  mutable Geometry neighbor_geometry_;
};

}  // namespace quadrille
