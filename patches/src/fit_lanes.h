#pragma once

#include "lanes.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Samples of one patch, kLaneCount of which are worked on at a time.
struct FitBatch {
  static constexpr int kSize = 64;
  static_assert(kSize % kLaneCount == 0);

  int count = 0;  ///< a multiple of kLaneCount; samples of weight 0 fill up
  alignas(64) float u[kSize], v[kSize], weight[kSize];
  Color color[kSize];  ///< what the patch ought to show
};

/// Control colours of a patch in Bezier form, by channel; 4 j + i weighs B_i(u) B_j(v).
using ControlColors = float[4][16];

/// Sums over the samples of one patch.
struct FitSums {
  double moments[49];      ///< see PatchElement
  double residual[4][16];  ///< color - model, times each Bernstein product
};

/// Adds a batch to the sums; channels from `channels` on are left out. Within a batch the sums are
/// in float, always in the same order.
void add_batch(const ControlColors& model, int channels, const FitBatch& batch, FitSums& sums);

/// The colours of the model at `count` parameters, a multiple of kLaneCount and at most
/// FitBatch::kSize.
void evaluate_batch(const ControlColors& model, int channels, int count, const float* u,
                    const float* v, float (&colors)[4][FitBatch::kSize]);

}  // namespace quadrille
