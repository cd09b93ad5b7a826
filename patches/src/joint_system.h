#pragma once

#include <vector>

#include "fit_system.h"
#include "motion_lanes.h"
#include "vertex_guides.h"

namespace quadrille {

/// Corrections of colours and moves of vertices, side by side.
struct JointVector {
  ColorSystem::Vector colors;
  std::vector<Eigen::Vector2f> moves;
};

/// The normal equations of a Gauss-Newton step on colours and vertex positions together: those of
/// the colours with what moves add to them. A move of a corner takes the patch's colours along by
/// the corner's bilinear weight, so a sample changes by its colour gradient times its displacement.
class JointSystem {
 public:
  /// `colors` is solved, its right-hand side holds what is left. `mean` is half the sum of the
  /// picture and what the patches show, premultiplied, with the picture's channels; its central
  /// differences are the gradients. The shape energy counts `shape_weight` times. Keeps references
  /// to the colours, the patches and the guides.
  JointSystem(ColorSystem& colors, const PatchMesh& patches,
              const std::vector<SampleBlock>& samples, const Raster& picture,
              const std::vector<Color>& mean, const VertexGuides& guides, double shape_weight);

  /// Steps that minimise the quadratic model with `damping` times each vertex's own stiffness added
  /// to it, by conjugate gradients with a block-Jacobi preconditioner to a relative residual of
  /// 0.1; less gains nothing over the rounds. Moves stay within their guides. Returns the number of
  /// iterations.
  int solve(double damping, JointVector& step);

 private:
  ColorSystem& colors_;
  const PatchMesh& patches_;
  const VertexGuides& guides_;
  std::vector<MotionGroup> groups_;
  std::vector<Eigen::Vector2f> force_;       // negative gradient by the vertices
  std::vector<Eigen::Matrix2f> stiffness_;   // per vertex
  std::vector<CornerUnknowns> color_parts_;  // per patch, and for empty places
  std::vector<CornerMoves> move_parts_;

  void assemble_block(const SampleBlock& samples, const Raster& picture,
                      const std::vector<Color>& mean, double shape_weight);
  void gather_vertices();
  Eigen::Matrix2f inverse_stiffness(int v, float damping) const;
  double multiply(const JointVector& x, float damping, JointVector& product);
};

}  // namespace quadrille
