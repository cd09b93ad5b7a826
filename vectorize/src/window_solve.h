#pragma once

#include <span>

#include "angle_field.h"

namespace quadrille {

/// A change of a period jump (p or q of the paper's Eq. 2) on the edge from a pixel to its right or
/// its lower neighbour.
struct JumpChange {
  int x = 0, y = 0;
  bool down = false;
  int change = 0;
};

/// Changes the jumps and minimises the energy over the angles in the window with all jumps fixed, a
/// linear problem; the angles around the window stay.
void solve_window(AngleField& field, const Window& window, std::span<const JumpChange> changes,
                  const RunContext& context);

}  // namespace quadrille
