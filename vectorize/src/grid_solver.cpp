// Trottenberg, Oosterlee, Schuller, Multigrid, 2001.
#include "grid_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel.h"

namespace quadrille {
namespace {

constexpr int kCoarsestSide = 4;
constexpr int kCoarsestSweeps = 20;

/// Real inner product in a fixed order: eight lanes a row, then the lanes, then the rows.
template <class T>
double dot(const FieldGrid<T>& a, const FieldGrid<T>& b, const RunContext& context) {
  const int n = a.width * static_cast<int>(sizeof(T) / sizeof(float));
  std::vector<double> rows(a.height);
  parallel_rows(context, a.height, a.width, [&](int y) {
    const auto* p = reinterpret_cast<const float*>(&a(0, y));
    const auto* q = reinterpret_cast<const float*>(&b(0, y));
    std::array<double, 8> lanes{};
    int k = 0;
    for (; k + 8 <= n; k += 8) {
      for (int lane = 0; lane < 8; ++lane) {
        lanes[lane] += static_cast<double>(p[k + lane]) * q[k + lane];
      }
    }
    for (; k < n; ++k) lanes[0] += static_cast<double>(p[k]) * q[k];
    for (double lane : lanes) rows[y] += lane;
  });
  double total = 0;
  for (double r : rows) total += r;
  return total;
}

/// a + factor * b, in the place of a or b.
template <class T>
void combine(const FieldGrid<T>& a, double factor, const FieldGrid<T>& b, FieldGrid<T>& result) {
  const float f = static_cast<float>(factor);
  const auto* p = reinterpret_cast<const float*>(a.data.data());
  const auto* q = reinterpret_cast<const float*>(b.data.data());
  auto* r = reinterpret_cast<float*>(result.data.data());
  const std::size_t n = a.data.size() * sizeof(T) / sizeof(float);
  for (std::size_t k = 0; k < n; ++k) r[k] = p[k] + f * q[k];
}

}  // namespace

template <class T>
GridSolver<T>::Plane::Plane(int width, int height)
    : height(height),
      stride(static_cast<std::size_t>(width + 2) * kComponents),
      data(stride * (height + 2)) {}

template <class T>
GridSolver<T>::GridSolver(const FieldGrid<float>& mass, const RunContext& context)
    : context_(context) {
  int w = mass.width, h = mass.height;
  while (true) {
    Level level{w, h, {w, h}, {w, h}, {w, h}, {w, h}, {w, h}, {}};
    for (int parity = 0; parity < 2; ++parity) {
      level.colour[parity].resize(static_cast<std::size_t>(w) * kComponents);
      for (std::size_t k = 0; k < level.colour[parity].size(); ++k) {
        level.colour[parity][k] = (k / kComponents + parity) % 2 == 0;
      }
    }
    levels_.push_back(std::move(level));
    if (std::max(w, h) <= kCoarsestSide) break;
    w = (w + 1) / 2;
    h = (h + 1) / 2;
  }
  set_mass(mass);
}

template <class T>
void GridSolver<T>::set_mass(const FieldGrid<float>& mass) {
  set_level_mass(mass, levels_.front());
  FieldGrid<float> coarse;
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    // The sum of squared differences does not depend on the spacing in two dimensions, so a coarse
    // edge keeps weight 1 while masses add up.
    const FieldGrid<float> fine = i == 1 ? mass : std::move(coarse);
    coarse = FieldGrid<float>(levels_[i].width, levels_[i].height);
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) coarse(x / 2, y / 2) += fine(x, y);
    }
    set_level_mass(coarse, levels_[i]);
  }
}

template <class T>
void GridSolver<T>::set_level_mass(const FieldGrid<float>& mass, Level& level) {
  const int w = mass.width, h = mass.height;
  for (int y = 0; y < h; ++y) {
    float *diagonal = level.diagonal.row(y), *inverse = level.inverse.row(y);
    const int vertical = (y > 0) + (y + 1 < h);
    for (int x = 0; x < w; ++x) {
      const float d = static_cast<float>(vertical + (x > 0) + (x + 1 < w)) + mass(x, y);
      for (int c = 0; c < kComponents; ++c) {
        diagonal[x * kComponents + c] = d;
        inverse[x * kComponents + c] = d > 0 ? 1 / d : 0;
      }
    }
  }
}

template <class T>
void GridSolver<T>::load(const FieldGrid<T>& grid, Plane& plane) const {
  for (int y = 0; y < grid.height; ++y) {
    const auto* from = reinterpret_cast<const float*>(&grid(0, y));
    std::copy_n(from, static_cast<std::size_t>(grid.width) * kComponents, plane.row(y));
  }
}

template <class T>
void GridSolver<T>::store(const Plane& plane, FieldGrid<T>& grid) const {
  for (int y = 0; y < grid.height; ++y) {
    auto* to = reinterpret_cast<float*>(&grid(0, y));
    std::copy_n(plane.row(y), static_cast<std::size_t>(grid.width) * kComponents, to);
  }
}

/// Gauss-Seidel on one colour of the checkerboard. All pixels are computed and the other colour
/// kept by a factor of 0, which vectorises; out of place, so that rows may run on any thread.
template <class T>
void GridSolver<T>::relax(Level& level, int colour) const {
  const int n = level.width * kComponents;
  parallel_rows(context_, level.height, level.width, [&](int y) {
    const float *up = level.x.row(y - 1), *x = level.x.row(y), *down = level.x.row(y + 1);
    const float *b = level.b.row(y), *inverse = level.inverse.row(y);
    const float* chosen = level.colour[(y + colour) & 1].data();
    float* __restrict next = level.next.row(y);
    for (int k = 0; k < n; ++k) {
      const float sum = (up[k] + down[k]) + (x[k - kComponents] + x[k + kComponents]);
      next[k] = x[k] + chosen[k] * ((b[k] + sum) * inverse[k] - x[k]);
    }
  });
  std::swap(level.x, level.next);
}

template <class T>
void GridSolver<T>::find_residual(Level& level) const {
  const int n = level.width * kComponents;
  parallel_rows(context_, level.height, level.width, [&](int y) {
    const float *up = level.x.row(y - 1), *x = level.x.row(y), *down = level.x.row(y + 1);
    const float *b = level.b.row(y), *diagonal = level.diagonal.row(y);
    float* __restrict residual = level.next.row(y);
    for (int k = 0; k < n; ++k) {
      const float sum = (up[k] + down[k]) + (x[k - kComponents] + x[k + kComponents]);
      residual[k] = b[k] + sum - diagonal[k] * x[k];
    }
  });
}

/// Bilinear interpolation between cell centres: a fine cell lies a quarter of a coarse cell off the
/// centre of its own, toward the other coarse neighbour, or toward nothing at the border.
template <class T>
void GridSolver<T>::prolong_add(std::size_t index) {
  Level& fine = levels_[index];
  Level& coarse = levels_[index + 1];
  constexpr int C = kComponents;
  parallel_rows(context_, fine.height, fine.width, [&](int y) {
    const int cy = y >> 1;
    const int other = std::clamp(cy + ((y & 1) ? 1 : -1), 0, coarse.height - 1);
    const float *near = coarse.x.row(cy), *far = coarse.x.row(other);
    const int n = coarse.width * C;
    thread_local std::vector<float> blend;
    blend.resize(n + 2 * C);
    float* mid = blend.data() + C;
    for (int k = 0; k < n; ++k) mid[k] = 0.75f * near[k] + 0.25f * far[k];
    for (int c = 0; c < C; ++c) mid[c - C] = mid[c], mid[n + c] = mid[n - C + c];
    float* __restrict x = fine.x.row(y);
    for (int i = 0; i < fine.width / 2; ++i) {
      for (int c = 0; c < C; ++c) {
        const float m = 0.75f * mid[i * C + c];
        x[2 * i * C + c] += m + 0.25f * mid[i * C + c - C];
        x[2 * i * C + C + c] += m + 0.25f * mid[i * C + c + C];
      }
    }
    if (fine.width & 1) {
      for (int c = 0; c < C; ++c) {
        x[(fine.width - 1) * C + c] += 0.75f * mid[n - C + c] + 0.25f * mid[n - 2 * C + c];
      }
    }
  });
}

/// The transpose of prolong_add, from `next` into the coarse level's right-hand side.
template <class T>
void GridSolver<T>::restrict_next(std::size_t index) {
  Level& fine = levels_[index];
  Level& coarse = levels_[index + 1];
  constexpr int C = kComponents;
  const int n = fine.width * C;
  // Beyond the border the interpolation leant on its own cell: the outermost row counts once more.
  const auto row_or_outermost = [&](int y) {
    if (y < 0) return fine.next.row(0);
    if (y == fine.height && y % 2 == 0) return fine.next.row(y - 1);
    return y < fine.height ? fine.next.row(y) : fine.next.row(-1);
  };
  parallel_rows(context_, coarse.height, fine.width, [&](int cy) {
    const float *a = row_or_outermost(2 * cy - 1), *b = fine.next.row(2 * cy);
    const float *c = row_or_outermost(2 * cy + 1), *d = row_or_outermost(2 * cy + 2);
    thread_local std::vector<float> blend;
    blend.assign(n + 4 * C, 0);
    float* mid = blend.data() + C;
    for (int k = 0; k < n; ++k) mid[k] = 0.25f * (a[k] + d[k]) + 0.75f * (b[k] + c[k]);
    for (int k = 0; k < C; ++k) {
      mid[k - C] = mid[k];
      if (fine.width % 2 == 0) mid[n + k] = mid[n - C + k];
    }
    float* __restrict out = coarse.b.row(cy);
    for (int i = 0; i < coarse.width; ++i) {
      for (int k = 0; k < C; ++k) {
        const float* m = mid + 2 * i * C + k;
        out[i * C + k] = 0.25f * (m[-C] + m[2 * C]) + 0.75f * (m[0] + m[C]);
      }
    }
  });
}

template <class T>
void GridSolver<T>::solve_coarsest() {
  Level& level = levels_.back();
  for (int s = 0; s < kCoarsestSweeps; ++s) relax(level, 0), relax(level, 1);
  for (int s = 0; s < kCoarsestSweeps; ++s) relax(level, 1), relax(level, 0);
}

template <class T>
void GridSolver<T>::cycle(std::size_t index) {
  if (index + 1 == levels_.size()) return solve_coarsest();
  Level& level = levels_[index];
  relax(level, 0);
  relax(level, 1);
  find_residual(level);
  restrict_next(index);
  Plane& correction = levels_[index + 1].x;
  std::fill(correction.data.begin(), correction.data.end(), 0.0f);
  cycle(index + 1);
  prolong_add(index);
  // The mirrored order makes the cycle symmetric, which conjugate gradients need.
  relax(level, 1);
  relax(level, 0);
}

template <class T>
FieldGrid<T> GridSolver<T>::estimate(const FieldGrid<T>& b) {
  load(b, levels_.front().b);
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    levels_[i].next = levels_[i].b;
    restrict_next(i);
  }
  std::fill(levels_.back().x.data.begin(), levels_.back().x.data.end(), 0.0f);
  solve_coarsest();
  // A cycle overwrites the right-hand sides of the coarser levels only, which are done with.
  for (std::size_t i = levels_.size() - 1; i-- > 0;) {
    std::fill(levels_[i].x.data.begin(), levels_[i].x.data.end(), 0.0f);
    prolong_add(i);
    cycle(i);
  }
  FieldGrid<T> x(b.width, b.height);
  store(levels_.front().x, x);
  return x;
}

template <class T>
void GridSolver<T>::improve(const FieldGrid<T>& b, FieldGrid<T>& x, int cycles) {
  load(b, levels_.front().b);
  load(x, levels_.front().x);
  for (int c = 0; c < cycles; ++c) cycle(0);
  store(levels_.front().x, x);
}

template <class T>
int GridSolver<T>::solve(const FieldGrid<T>& b, FieldGrid<T>& x, double tolerance,
                         int max_iterations) {
  Level& finest = levels_.front();
  load(b, finest.b);
  load(x, finest.x);
  find_residual(finest);
  FieldGrid<T> residual(b.width, b.height), corrected = residual, direction = residual,
                                            image = residual;
  store(finest.next, residual);
  const double target = tolerance * tolerance * dot(b, b, context_);
  double previous = 0;
  int iteration = 0;
  while (iteration < max_iterations && dot(residual, residual, context_) > target) {
    load(residual, finest.b);
    std::fill(finest.x.data.begin(), finest.x.data.end(), 0.0f);
    cycle(0);
    store(finest.x, corrected);
    const double current = dot(residual, corrected, context_);
    if (!(current > 0)) break;
    combine(corrected, previous > 0 ? current / previous : 0, direction, direction);
    previous = current;
    std::fill(finest.b.data.begin(), finest.b.data.end(), 0.0f);
    load(direction, finest.x);
    find_residual(finest);  // minus the matrix times the direction
    store(finest.next, image);
    const double step = -current / dot(direction, image, context_);
    combine(x, step, direction, x);
    combine(residual, step, image, residual);
    ++iteration;
  }
  return iteration;
}

template class GridSolver<float>;
template class GridSolver<std::complex<float>>;

}  // namespace quadrille
