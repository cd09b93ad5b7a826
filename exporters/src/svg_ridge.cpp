#include "svg_ridge.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quadrille {
namespace {

/// Share of the weights with which neighbouring stops are drawn together, which decides where no
/// sample does, and with which a sum of two is pulled toward zero, which decides the constant that
/// can move from one to the other.
constexpr double kSmoothing = 1e-4, kPull = 1e-7;

template <int Size>
RidgeSolution<Size> solved(const Eigen::Matrix<double, Size, Size>& matrix,
                           const Eigen::Matrix<double, Size, 3>& right, int n) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Size, Size>;
  const Matrix block = matrix.topLeftCorner(n, n);
  RidgeSolution<Size> solution;
  solution.stops = block.llt().solve(right.topRows(n));
  // For the exact minimum x of x'Ax - 2 b'x the value there is -b'x.
  solution.explained = solution.stops.cwiseProduct(right.topRows(n)).sum();
  return solution;
}

using UnitPlaces = std::array<double, CellSamples::kCount>;

Eigen::Vector2d direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// How far along a direction the samples lie in the unit square of the bounds.
UnitPlaces places_along(const CellSamples& samples, const Eigen::AlignedBox2d& bounds,
                        const Eigen::Vector2d& along) {
  UnitPlaces places;
  for (int i = 0; i < CellSamples::kCount; ++i) {
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
  const auto [least, most] = std::minmax_element(axis.place.begin(), axis.place.end());
  constexpr int n = 8;  // of the extent
  const auto eighths = [&](double place) { return (place - low) / extent * n; };
  const int first = std::clamp(static_cast<int>(std::floor(eighths(*least) + 0.3)), 0, n - 1);
  const int last = std::clamp(static_cast<int>(std::ceil(eighths(*most) - 0.3)), first + 1, n);
  axis.vector = {(low + extent * first / n) * along, (low + extent * last / n) * along, true};
  for (double& place : axis.place) place = (eighths(place) - first) / (last - first);
  return axis;
}

RidgeAxis own_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds,
                   const AxisRange& range) {
  const Eigen::Vector2d along = direction_of(range.angle);
  const UnitPlaces places = places_along(samples, bounds, along);
  const auto [least, most] = std::minmax_element(places.begin(), places.end());
  const double extent = std::max(*most - *least, 1e-3);
  RidgeAxis axis;
  axis.vector =
      vector_between(along, *least + range.before * extent, *least + (1 - range.after) * extent);
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

RidgeSystem::RidgeSystem(const CellSamples& samples, const RidgeAxis& axis, int stop_count)
    : stops(stop_count) {
  matrix.setZero();
  right.setZero();
  double total = 0;
  for (int i = 0; i < CellSamples::kCount; ++i) {
    place[i] = ridge_place(axis.place[i], stops);
    const auto [k, f] = place[i];
    const double w = samples.weight[i];
    total += w;
    matrix(k, k) += w * (1 - f) * (1 - f);
    matrix(k + 1, k) += w * f * (1 - f);
    matrix(k + 1, k + 1) += w * f * f;
    right.row(k) += (w * (1 - f)) * samples.color[i].matrix().transpose();
    right.row(k + 1) += (w * f) * samples.color[i].matrix().transpose();
  }
  const double smoothing = kSmoothing * total / stops + 1e-9;
  for (int k = 0; k + 1 < stops; ++k) {
    matrix(k, k) += smoothing;
    matrix(k + 1, k + 1) += smoothing;
    matrix(k + 1, k) -= smoothing;
  }
  for (int k = 0; k < stops; ++k) matrix(k, k) += kPull * total + 1e-12;
  for (int k = 0; k + 1 < stops; ++k) matrix(k, k + 1) = matrix(k + 1, k);
}

RidgeSolution<RidgeSystem::kSize> solve_ridge(const RidgeSystem& system) {
  return solved<RidgeSystem::kSize>(system.matrix, system.right, system.stops);
}

RidgeSolution<2 * RidgeSystem::kSize> solve_ridges(const CellSamples& samples, const RidgeSystem& a,
                                                   const RidgeSystem& b) {
  constexpr int kSize = 2 * RidgeSystem::kSize;
  const int m = a.stops, n = b.stops;
  Eigen::Matrix<double, kSize, kSize> matrix;
  Eigen::Matrix<double, kSize, 3> right;
  matrix.topLeftCorner(m, m) = a.matrix.topLeftCorner(m, m);
  matrix.block(m, m, n, n) = b.matrix.topLeftCorner(n, n);
  auto between = matrix.block(m, 0, n, m);
  between.setZero();
  for (int i = 0; i < CellSamples::kCount; ++i) {
    const auto [j, f] = a.place[i];
    const auto [k, g] = b.place[i];
    const double w = samples.weight[i];
    between(k, j) += w * (1 - f) * (1 - g);
    between(k, j + 1) += w * f * (1 - g);
    between(k + 1, j) += w * (1 - f) * g;
    between(k + 1, j + 1) += w * f * g;
  }
  matrix.block(0, m, m, n) = between.transpose();
  right.topRows(m) = a.right.topRows(m);
  right.middleRows(m, n) = b.right.topRows(n);
  return solved<kSize>(matrix, right, m + n);
}

}  // namespace quadrille
