#pragma once

#include <string>
#include <vector>

#include "quadrille/vectorize.h"

namespace quadrille::bench {

/// A cross field after one phase of its making, or by another method on the same input.
struct FieldPhase {
  std::string name;
  int singularities = 0;
  double misalignment = 0;  ///< degrees, see misalignment_degrees()
};

/// The phases of the cross field in their order, then the methods it is compared with. A row of
/// the paper's Table 1.
std::vector<FieldPhase> field_phases(const Quadrangulation& quads);

}  // namespace quadrille::bench
