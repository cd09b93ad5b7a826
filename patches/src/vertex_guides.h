#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// How far and in which ways the vertices of a mesh may move so that its outline and its tears stay
/// where they are.
///
/// Border vertices slide along straight axis-parallel borders; where the border bends or runs
/// obliquely they stay. Vertices inside a chain of tear edges slide along it; they stay where it
/// ends, meets another one or the border, or turns by more than 45 degrees.
class VertexGuides {
 public:
  /// Keeps a reference to the patches, whose geometry is the one that vertices start from.
  explicit VertexGuides(const PatchMesh& patches);

  enum class Kind { free, line, chain, fixed };
  Kind kind(int v) const { return guides_[v].kind; }
  /// The unit direction of a line or chain at vertex v.
  const Eigen::Vector2d& direction(int v) const { return guides_[v].direction; }

  /// Where a step takes vertex v: as far as the step's component along the guide, and in a chain
  /// along the curves of its edges.
  Eigen::Vector2d moved(int v, const Eigen::Vector2d& step) const;

 private:
  struct Guide {
    Kind kind = Kind::free;
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();
    std::array<int, 2> ahead_behind = {-1, -1};  ///< half-edges of a chain that leave the vertex
  };
  Guide border_guide(int v) const;
  Guide tear_guide(int v) const;
  Eigen::Vector2d along_edge(int h, double distance) const;

  const PatchMesh& patches_;
  std::vector<Guide> guides_;
};

}  // namespace quadrille
