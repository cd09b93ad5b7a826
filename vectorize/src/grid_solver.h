#pragma once

#include <complex>

#include "quadrille/field_grid.h"
#include "quadrille/run_context.h"

namespace quadrille {

using ComplexGrid = FieldGrid<std::complex<float>>;

/// Solves (L + diag(mass)) x = b on a pixel grid, where L is the graph Laplacian of the
/// 4-neighbourhood with unit weights and mass >= 0 is not zero everywhere.
class GridSolver {
 public:
  GridSolver(FieldGrid<float> mass, const RunContext& context);

  /// Conjugate gradients preconditioned by a symmetric multigrid V-cycle, starting from x, until
  /// the residual has shrunk to `tolerance` of b's norm. Returns the number of iterations.
  int solve(const ComplexGrid& b, ComplexGrid& x, double tolerance, int max_iterations) const;

 private:
  struct Level {
    FieldGrid<float> mass;
  };
  std::vector<Level> levels_;
  const RunContext& context_;

  void cycle(std::size_t level, const ComplexGrid& b, ComplexGrid& x) const;
  void relax(const Level& level, const ComplexGrid& b, ComplexGrid& x, int colour) const;
  ComplexGrid apply(const Level& level, const ComplexGrid& x) const;
};

}  // namespace quadrille
