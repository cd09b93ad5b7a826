#pragma once

#include <string>
#include <vector>

#include "quadrille/vectorize.h"

namespace quadrille::bench {

/// A way of estimating colours, by the name that the command gives it.
struct FitMode {
  std::string name;
  FitMethod method;
  /// Numbers per wedge and channel from which the patches follow: the Bessel schemes derive all
  /// derivatives from the values.
  int scalars = 4;
};

/// What the command offers.
const std::vector<FitMode>& fit_modes();

/// One run: a kind of mesh with a way of estimating colours and a wished number of quads.
struct FitRun {
  FitMode fit;
  bool lattice = false;
  int quads = 3000;

  std::string mesh_name() const { return lattice ? "lattice" : "mesh"; }
  VectorizeOptions options() const;
};

/// Every fit with the mesh and with the lattice, for every number of quads. Throws
/// Error{invalid_argument} for a name that is none of fit_modes(); no name at all means all.
std::vector<FitRun> fit_runs(const std::vector<std::string>& fits, const std::vector<int>& quads);

}  // namespace quadrille::bench
