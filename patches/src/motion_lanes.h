#pragma once

#include <Eigen/Core>
#include <array>

#include "element_lanes.h"
#include "fit_lanes.h"

namespace quadrille {

/// Samples of one patch with what they say about moving its corners. A corner's move takes a sample
/// along by its bilinear weight at the sample's parameters.
struct MotionBatch {
  int count = 0;  ///< a multiple of kLaneCount; samples without a gradient fill up
  alignas(64) float u[FitBatch::kSize], v[FitBatch::kSize];
  Color residual[FitBatch::kSize];     ///< picture - model
  Color gradient[2][FitBatch::kSize];  ///< of the model along x and y, per pixel
};

/// Sums over the samples of one patch, all with powers of parameters in the manner of
/// uniform_moments(): for products of a cubic Bernstein product and a corner's bilinear weight
/// degree 4, for products of two bilinear weights degree 2.
struct MotionSums {
  double mixed[4][2][25];  ///< gradient, per channel
  double stiffness[3][9];  ///< products xx, xy, yy of gradients, over all channels
  double force[4][2];      ///< residual times gradient times the corner's weight
};

void add_batch(int channels, const MotionBatch& batch, MotionSums& sums);

/// What kLaneCount patches say about moves of their corners, side by side, in the order of an
/// ElementGroup. Moves are numbered 2 corner + axis.
struct MotionGroup {
  alignas(64) float mixed[4][2][25][kLaneCount] = {};
  float stiffness[64][kLaneCount] = {};
  int vertices[4][kLaneCount] = {};
};

using CornerMoves = std::array<Eigen::Vector2f, 4>;

/// The matrix of kLaneCount patches times colours and moves together: colors[lane] for the unknown
/// colours, moves[lane] for the moves. One pass for both, as they share the way to Bezier form.
void multiply(const ElementGroup& group, const MotionGroup& motion, int channels,
              const WedgeUnknowns* x, const Eigen::Vector2f* p, CornerUnknowns* colors,
              CornerMoves* moves);

}  // namespace quadrille
