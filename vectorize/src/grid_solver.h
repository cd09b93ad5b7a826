#pragma once

#include <complex>
#include <vector>

#include "quadrille/field_grid.h"
#include "quadrille/run_context.h"

namespace quadrille {

using ComplexGrid = FieldGrid<std::complex<float>>;

/// Solves (L + diag(mass)) x = b on a pixel grid, where L is the graph Laplacian of the
/// 4-neighbourhood with unit weights and mass >= 0 is not zero everywhere. T is float or
/// std::complex<float>. Keeps its work space between calls: one solver serves one thread of
/// control, though its sweeps use the context's threads.
template <class T>
class GridSolver {
 public:
  GridSolver(const FieldGrid<float>& mass, const RunContext& context);

  /// Another mass of the same size.
  void set_mass(const FieldGrid<float>& mass);

  /// Conjugate gradients preconditioned by a symmetric multigrid V-cycle, starting from x, until
  /// the residual has shrunk to `tolerance` of b's norm. Returns the number of iterations.
  int solve(const FieldGrid<T>& b, FieldGrid<T>& x, double tolerance, int max_iterations);

  /// Full multigrid: solves on the coarsest level, then interpolates and improves by one V-cycle
  /// level by level. A start within a few per cent of the solution.
  FieldGrid<T> estimate(const FieldGrid<T>& b);

  /// V-cycles from x: what a good start or a slightly changed b needs.
  void improve(const FieldGrid<T>& b, FieldGrid<T>& x, int cycles);

 private:
  /// T as this many floats, so that the loops run over plain numbers.
  static constexpr int kComponents = sizeof(T) / sizeof(float);

  /// Rows of floats with a frame of zeros, one pixel wide: no branches at the border.
  struct Plane {
    int height = 0;
    std::size_t stride = 0;
    std::vector<float> data;

    Plane() = default;
    Plane(int width, int height);
    float* row(int y) { return data.data() + (y + 1) * stride + kComponents; }
    const float* row(int y) const { return data.data() + (y + 1) * stride + kComponents; }
  };

  struct Level {
    int width = 0, height = 0;
    Plane diagonal, inverse;  // of the matrix, repeated for each component
    Plane x, b;
    Plane next;                    // of x, and the residual
    std::vector<float> colour[2];  // 1 on the pixels of a checkerboard's colour in even, odd rows
  };

  std::vector<Level> levels_;
  const RunContext& context_;

  static void set_level_mass(const FieldGrid<float>& mass, Level& level);
  void load(const FieldGrid<T>& grid, Plane& plane) const;
  void store(const Plane& plane, FieldGrid<T>& grid) const;
  void relax(Level& level, int colour) const;
  void find_residual(Level& level) const;
  void restrict_next(std::size_t level);
  void prolong_add(std::size_t level);
  void cycle(std::size_t level);
  void solve_coarsest();
};

extern template class GridSolver<float>;
extern template class GridSolver<std::complex<float>>;

}  // namespace quadrille
