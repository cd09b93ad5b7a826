#include "svg_ridge.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

/// Share of the weights with which neighbouring stops are drawn together, which decides where no
/// sample does, and with which a sum of two is pulled toward zero, which decides the constant that
/// can move from one to the other.
constexpr double kSmoothing = 1e-4, kPull = 1e-7;

/// Normal equations of stop colours, one row per stop: of the matrix the lower triangle.
template <int Size>
class StopEquations {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Size, Size>;

  Matrix matrix;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, Size, 3> right;

  explicit StopEquations(int count) : matrix(count, count), right(count, 3) { matrix.setZero(); }

  /// Those of one axis, whose stops begin at number `first`.
  void add(const RidgeSystem& system, int first) {
    for (int k = 0; k < system.stops; ++k) {
      matrix(first + k, first + k) = system.right_and_diagonal[k][3];
      if (k > 0) matrix(first + k, first + k - 1) = system.below[k - 1];
      right.row(first + k) = system.right_and_diagonal[k].head<3>();
    }
  }

  /// The product of the stops of two axes, the second's after the first's.
  void add_products(const WeightedColors& colors, const RidgeSystem& a, const RidgeSystem& b) {
    for (int i = 0; i < colors.count; ++i) {
      const auto [j, f] = a.place[i];
      const auto [k, g] = b.place[i];
      const double w = colors.sample[i][3];
      auto products = matrix.template block<2, 2>(a.stops + k, j);
      products(0, 0) += w * (1 - f) * (1 - g);
      products(0, 1) += w * f * (1 - g);
      products(1, 0) += w * (1 - f) * g;
      products(1, 1) += w * f * g;
    }
  }

  RidgeSolution<Size> solve() {
    RidgeSolution<Size> solution;
    Eigen::LLT<Eigen::Ref<decltype(matrix)>> factors(matrix);
    solution.stops = right;
    factors.solveInPlace(solution.stops);
    // For the exact minimum x of x'Ax - 2 b'x the value there is -b'x.
    solution.explained = right.cwiseProduct(solution.stops).sum();
    return solution;
  }

  /// See thinned_ridge(); the second axis, if there is one, starts at stop number `second`.
  RidgeSolution<Size> solve_thinned(double worth, int second) {
    const int n = static_cast<int>(right.rows());
    Matrix inverse = Matrix::Identity(n, n);
    Eigen::LLT<Matrix>(matrix).solveInPlace(inverse);
    RidgeSolution<Size> solution{.stops = inverse * right};
    solution.explained = right.cwiseProduct(solution.stops).sum();
    while (leave_out_least(solution, inverse, worth, second)) {
    }
    return solution;
  }

 private:
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Size, 1>;

  /// False when no stop is worth leaving out. `inverse` is that of the matrix under the conditions
  /// that are met already.
  static bool leave_out_least(RidgeSolution<Size>& solution, Matrix& inverse, double worth,
                              int second) {
    const int n = static_cast<int>(inverse.rows());
    int least = -1;
    double rise = worth, least_scale = 0;
    Column least_column(n);
    Eigen::RowVector3d least_bend;
    for (int k = 1; k + 1 < n; ++k) {
      if (k == second - 1 || k == second || solution.left_out[k]) continue;
      int before = k - 1, after = k + 1;
      while (solution.left_out[before]) --before;
      while (solution.left_out[after]) ++after;
      const double share = double(k - before) / (after - before);
      // The condition is c'x = 0: stop k lies on the line between its neighbours. The minimum under
      // one more condition lies (c'x)^2 / (c' A^-1 c) higher.
      const auto bend_of = [&](const auto& rows) {
        return (rows.row(k) - (1 - share) * rows.row(before) - share * rows.row(after)).eval();
      };
      const Column column = bend_of(inverse).transpose();
      const double scale = bend_of(column)[0];
      const Eigen::RowVector3d bend = bend_of(solution.stops);
      if (!(bend.squaredNorm() < rise * scale)) continue;
      rise = bend.squaredNorm() / scale;
      least = k;
      least_column = column;
      least_scale = scale;
      least_bend = bend;
    }
    if (least < 0) return false;
    solution.stops -= least_column * (least_bend / least_scale);
    inverse -= least_column * least_column.transpose() / least_scale;
    solution.explained -= rise;
    solution.left_out[least] = true;
    return true;
  }
};

StopEquations<RidgeSystem::kSize> equations_of(const RidgeSystem& system) {
  StopEquations<RidgeSystem::kSize> equations(system.stops);
  equations.add(system, 0);
  return equations;
}

StopEquations<2 * RidgeSystem::kSize> equations_of(const WeightedColors& colors,
                                                   const RidgeSystem& a, const RidgeSystem& b) {
  StopEquations<2 * RidgeSystem::kSize> equations(a.stops + b.stops);
  equations.add(a, 0);
  equations.add(b, a.stops);
  equations.add_products(colors, a, b);
  return equations;
}

using UnitPlaces = std::array<double, CellSamples::kMost>;

Eigen::Vector2d direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// How far along a direction the samples lie in the unit square of the bounds.
UnitPlaces places_along(const CellSamples& samples, const Eigen::AlignedBox2d& bounds,
                        const Eigen::Vector2d& along) {
  UnitPlaces places{};
  for (int i = 0; i < samples.count; ++i) {
    const Eigen::Vector2d unit =
        (samples.position[i] - bounds.min()).cwiseQuotient(bounds.sizes().cwiseMax(1e-9));
    places[i] = unit.dot(along);
  }
  return places;
}

/// The vector whose gradient runs along a unit vector from the place `first` to `last`. One end's
/// coordinate is 0: any other vector between the same two lines shows the same.
GradientVector vector_between(const Eigen::Vector2d& along, double first, double last) {
  const int axis = std::abs(along.x()) >= std::abs(along.y()) ? 0 : 1;
  GradientVector vector{.is_common = false};
  vector.from[axis] = first / along[axis];
  vector.from[1 - axis] = 0;
  const double length = last - first;
  vector.to = vector.from + length * along;
  // A place far along the lines errs by the rounding over the square of the length.
  constexpr double kError = 0.02;
  constexpr int kMostDigits = 4;
  double step = 1;
  for (int digits = 0; digits < kMostDigits && step > kError * length * length; ++digits) {
    step /= 10;
  }
  for (Eigen::Vector2d* end : {&vector.from, &vector.to}) {
    *end = (*end / step).array().round() * step;
  }
  return vector;
}

}  // namespace

RidgeAxis common_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds,
                      int direction) {
  const Eigen::Vector2d along = direction_of(std::numbers::pi * direction / kCommonDirections);
  // Places in the unit square are measured from corner to corner along the direction.
  const double low = std::min(0.0, along.x()) + std::min(0.0, along.y());
  const double extent = std::abs(along.x()) + std::abs(along.y());
  RidgeAxis axis;
  axis.place = places_along(samples, bounds, along);
  const auto [least, most] =
      std::minmax_element(axis.place.begin(), axis.place.begin() + samples.count);
  constexpr int n = 8;  // of the extent
  const auto eighths = [&](double place) { return (place - low) / extent * n; };
  const int first = std::clamp(static_cast<int>(std::floor(eighths(*least) + 0.3)), 0, n - 1);
  const int last = std::clamp(static_cast<int>(std::ceil(eighths(*most) - 0.3)), first + 1, n);
  axis.vector = {(low + extent * first / n) * along, (low + extent * last / n) * along, true};
  for (double& place : axis.place) place = (eighths(place) - first) / (last - first);
  return axis;
}

RidgeAxis own_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, double angle) {
  const Eigen::Vector2d along = direction_of(angle);
  const UnitPlaces places = places_along(samples, bounds, along);
  const auto [least, most] = std::minmax_element(places.begin(), places.begin() + samples.count);
  RidgeAxis axis;
  axis.vector = vector_between(along, *least, std::max(*most, *least + 1e-3));
  const Eigen::Vector2d by = axis.vector.to - axis.vector.from;
  const double squared = by.squaredNorm();
  if (squared > 0) {
    axis.place = places_along(samples, bounds, by / squared);
    const double start = axis.vector.from.dot(by) / squared;
    for (double& place : axis.place) place -= start;
  }
  return axis;
}

double steepest_angle(const CellSamples& samples, const Eigen::AlignedBox2d& bounds) {
  // A function of the picture rises along the unit square's axes as its bounds are long.
  const Eigen::Matrix2d scale = bounds.sizes().asDiagonal();
  const Eigen::Matrix2d tensor = samples.slopes;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(tensor);
  const Eigen::Vector2d along = scale * eigen.eigenvectors().col(1);
  return std::atan2(along.y(), along.x());
}

WeightedColors::WeightedColors(const CellSamples& samples) : count(samples.count) {
  for (int i = 0; i < count; ++i) {
    sample[i].head<3>() = samples.color[i] * samples.weight[i];
    sample[i][3] = samples.weight[i];
  }
}

RidgeSystem::RidgeSystem(const WeightedColors& colors, const RidgeAxis& axis, int stop_count)
    : stops(stop_count) {
  // Two sums each, since one addition to a sum waits for the one before.
  std::array<std::array<Eigen::Array4d, 2>, kSize> sums;
  std::array<std::array<double, 2>, kSize> between{};
  for (auto& sum : sums) sum.fill(Eigen::Array4d::Zero());
  for (int i = 0; i < colors.count; ++i) {
    place[i] = ridge_place(axis.place[i], stops);
    const auto [k, f] = place[i];
    const Eigen::Array4d next = f * colors.sample[i];
    sums[k][i & 1] += colors.sample[i] - next;
    sums[k + 1][i & 1] += next;
    between[k][i & 1] += next[3] * (1 - f);
  }
  double total = 0;
  for (int k = 0; k < stops; ++k) {
    right_and_diagonal[k] = sums[k][0] + sums[k][1];
    below[k] = between[k][0] + between[k][1];
    total += right_and_diagonal[k][3];
  }
  // The squares of the factors f and 1 - f are what their products leave of them.
  for (int k = 0; k < stops; ++k) {
    right_and_diagonal[k][3] -= below[k] + (k > 0 ? below[k - 1] : 0);
  }
  const double smoothing = kSmoothing * total / stops + 1e-9;
  for (int k = 0; k + 1 < stops; ++k) {
    right_and_diagonal[k][3] += smoothing;
    right_and_diagonal[k + 1][3] += smoothing;
    below[k] -= smoothing;
  }
  for (int k = 0; k < stops; ++k) right_and_diagonal[k][3] += kPull * total + 1e-12;
}

RidgeSolution<RidgeSystem::kSize> solve_ridge(const RidgeSystem& system) {
  return equations_of(system).solve();
}

RidgeSolution<2 * RidgeSystem::kSize> solve_ridges(const WeightedColors& colors,
                                                   const RidgeSystem& a, const RidgeSystem& b) {
  return equations_of(colors, a, b).solve();
}

RidgeSolution<RidgeSystem::kSize> thinned_ridge(const RidgeSystem& system, double worth) {
  return equations_of(system).solve_thinned(worth, system.stops);
}

RidgeSolution<2 * RidgeSystem::kSize> thinned_ridges(const WeightedColors& colors,
                                                     const RidgeSystem& a, const RidgeSystem& b,
                                                     double worth) {
  return equations_of(colors, a, b).solve_thinned(worth, a.stops);
}

}  // namespace quadrille
