#include "grid_solver.h"

#include <algorithm>
#include <cmath>

#include "parallel.h"

namespace quadrille {
namespace {

using Complex = std::complex<float>;

constexpr int kCoarsestSide = 4;
constexpr int kCoarsestSweeps = 20;

/// Real inner product in a fixed order: rows are summed one by one, then the rows' sums.
double dot(const ComplexGrid& a, const ComplexGrid& b, const RunContext& context) {
  std::vector<double> rows(a.height);
  parallel_rows(context, a.height, a.width, [&](int y) {
    double sum = 0;
    for (int x = 0; x < a.width; ++x) {
      const Complex p = a(x, y), q = b(x, y);
      sum += p.real() * q.real() + p.imag() * q.imag();
    }
    rows[y] = sum;
  });
  double total = 0;
  for (double r : rows) total += r;
  return total;
}

void add_scaled(ComplexGrid& a, double factor, const ComplexGrid& b) {
  const float f = static_cast<float>(factor);
  for (std::size_t i = 0; i < a.data.size(); ++i) a.data[i] += f * b.data[i];
}

/// Bilinear interpolation between cell centres: fine cell x lies in coarse cell x / 2, a quarter of
/// a coarse cell off its centre, toward the other coarse neighbour.
int outer_neighbour(int fine, int coarse_count) {
  return std::clamp((fine >> 1) + ((fine & 1) ? 1 : -1), 0, coarse_count - 1);
}

void prolong_add(const ComplexGrid& coarse, ComplexGrid& fine, const RunContext& context) {
  parallel_rows(context, fine.height, fine.width, [&](int y) {
    const int cy = y >> 1, oy = outer_neighbour(y, coarse.height);
    for (int x = 0; x < fine.width; ++x) {
      const int cx = x >> 1, ox = outer_neighbour(x, coarse.width);
      fine(x, y) += 0.5625f * coarse(cx, cy) + 0.1875f * (coarse(ox, cy) + coarse(cx, oy)) +
                    0.0625f * coarse(ox, oy);
    }
  });
}

/// The transpose of prolong_add.
ComplexGrid restrict_sum(const ComplexGrid& fine, int coarse_width, int coarse_height) {
  ComplexGrid coarse(coarse_width, coarse_height);
  for (int y = 0; y < fine.height; ++y) {
    const int cy = y >> 1, oy = outer_neighbour(y, coarse_height);
    for (int x = 0; x < fine.width; ++x) {
      const int cx = x >> 1, ox = outer_neighbour(x, coarse_width);
      const Complex f = fine(x, y);
      coarse(cx, cy) += 0.5625f * f;
      coarse(ox, cy) += 0.1875f * f;
      coarse(cx, oy) += 0.1875f * f;
      coarse(ox, oy) += 0.0625f * f;
    }
  }
  return coarse;
}

Complex neighbour_sum(const ComplexGrid& x, int i, int j, int& count) {
  Complex sum = 0;
  count = 0;
  if (i > 0) sum += x(i - 1, j), ++count;
  if (i + 1 < x.width) sum += x(i + 1, j), ++count;
  if (j > 0) sum += x(i, j - 1), ++count;
  if (j + 1 < x.height) sum += x(i, j + 1), ++count;
  return sum;
}

}  // namespace

GridSolver::GridSolver(FieldGrid<float> mass, const RunContext& context) : context_(context) {
  levels_.push_back({std::move(mass)});
  while (std::max(levels_.back().mass.width, levels_.back().mass.height) > kCoarsestSide) {
    const FieldGrid<float>& fine = levels_.back().mass;
    // The sum of squared differences does not depend on the spacing in two dimensions, so a coarse
    // edge keeps weight 1 while masses add up.
    FieldGrid<float> coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) coarse(x / 2, y / 2) += fine(x, y);
    }
    levels_.push_back({std::move(coarse)});
  }
}

void GridSolver::relax(const Level& level, const ComplexGrid& b, ComplexGrid& x, int colour) const {
  parallel_rows(context_, x.height, x.width, [&](int j) {
    for (int i = (j + colour) & 1; i < x.width; i += 2) {
      int count;
      const Complex sum = neighbour_sum(x, i, j, count);
      const float diagonal = count + level.mass(i, j);
      if (diagonal > 0) x(i, j) = (b(i, j) + sum) / diagonal;
    }
  });
}

ComplexGrid GridSolver::apply(const Level& level, const ComplexGrid& x) const {
  ComplexGrid result(x.width, x.height);
  parallel_rows(context_, x.height, x.width, [&](int j) {
    for (int i = 0; i < x.width; ++i) {
      int count;
      const Complex sum = neighbour_sum(x, i, j, count);
      result(i, j) = (count + level.mass(i, j)) * x(i, j) - sum;
    }
  });
  return result;
}

void GridSolver::cycle(std::size_t index, const ComplexGrid& b, ComplexGrid& x) const {
  const Level& level = levels_[index];
  if (index + 1 == levels_.size()) {
    for (int s = 0; s < kCoarsestSweeps; ++s) {
      relax(level, b, x, 0);
      relax(level, b, x, 1);
    }
    for (int s = 0; s < kCoarsestSweeps; ++s) {
      relax(level, b, x, 1);
      relax(level, b, x, 0);
    }
    return;
  }
  relax(level, b, x, 0);
  relax(level, b, x, 1);
  ComplexGrid residual = apply(level, x);
  for (std::size_t i = 0; i < residual.data.size(); ++i) {
    residual.data[i] = b.data[i] - residual.data[i];
  }
  const FieldGrid<float>& coarse_mass = levels_[index + 1].mass;
  const ComplexGrid coarse_b = restrict_sum(residual, coarse_mass.width, coarse_mass.height);
  ComplexGrid correction(coarse_mass.width, coarse_mass.height);
  cycle(index + 1, coarse_b, correction);
  prolong_add(correction, x, context_);
  // The mirrored order makes the cycle symmetric, which conjugate gradients need.
  relax(level, b, x, 1);
  relax(level, b, x, 0);
}

int GridSolver::solve(const ComplexGrid& b, ComplexGrid& x, double tolerance,
                      int max_iterations) const {
  const Level& finest = levels_.front();
  ComplexGrid residual = apply(finest, x);
  for (std::size_t i = 0; i < b.data.size(); ++i) residual.data[i] = b.data[i] - residual.data[i];
  const double target = tolerance * tolerance * dot(b, b, context_);
  ComplexGrid direction(x.width, x.height);
  double previous = 0;
  int iteration = 0;
  while (iteration < max_iterations && dot(residual, residual, context_) > target) {
    ComplexGrid corrected(x.width, x.height);
    cycle(0, residual, corrected);
    const double current = dot(residual, corrected, context_);
    if (!(current > 0)) break;
    const double beta = previous > 0 ? current / previous : 0;
    for (std::size_t i = 0; i < x.data.size(); ++i) {
      direction.data[i] = corrected.data[i] + static_cast<float>(beta) * direction.data[i];
    }
    previous = current;
    const ComplexGrid image = apply(finest, direction);
    const double step = current / dot(direction, image, context_);
    add_scaled(x, step, direction);
    add_scaled(residual, -step, image);
    ++iteration;
  }
  return iteration;
}

}  // namespace quadrille
