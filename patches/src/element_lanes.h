#pragma once

#include <array>

#include "fit_element.h"
#include "lanes.h"

namespace quadrille {

/// The shares of kLaneCount patches in the normal equations, side by side; the last index of each
/// array is the patch. Places without a patch have zero moments and refer to wedge 0.
struct ElementGroup {
  alignas(64) float moments[49][kLaneCount] = {};  ///< 7 q + p, see uniform_moments()
  float corners[4][7][kLaneCount] = {};            ///< the numbers of CornerMap in their order
  int wedges[4][kLaneCount] = {};                  ///< per corner

  void set(int lane, const std::array<CornerMap, 4>& maps, const double (&sums)[49],
           const int* wedge_of_corner);
};

/// result[lane] = matrix of the patch times the unknowns of its corners. Channels from `channels`
/// on give zeros.
void multiply(const ElementGroup& group, int channels, const WedgeUnknowns* x,
              CornerUnknowns* result);

/// result[lane][k] = the block of the patch's matrix that couples the unknowns of corner k with
/// each other.
void diagonal_blocks(const ElementGroup& group, CornerUnknowns* result);

}  // namespace quadrille
