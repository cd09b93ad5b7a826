#include "svg_ridge.h"

#include <Eigen/Cholesky>
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

}  // namespace

RidgeAxis ridge_axis(const CellSamples& samples, const Eigen::AlignedBox2d& bounds, int direction) {
  const double angle = std::numbers::pi * direction / LinearGradient::kDirections;
  const Eigen::Vector2d along = Eigen::Vector2d(std::cos(angle), std::sin(angle));
  // Places in the unit square are measured from corner to corner along the direction.
  const double low = std::min(0.0, along.x()) + std::min(0.0, along.y());
  const double extent = std::abs(along.x()) + std::abs(along.y());
  RidgeAxis axis;
  double least = std::numeric_limits<double>::max(), most = -least;
  for (int i = 0; i < CellSamples::kCount; ++i) {
    const Eigen::Vector2d unit =
        (samples.position[i] - bounds.min()).cwiseQuotient(bounds.sizes().cwiseMax(1e-9));
    axis.place[i] = (unit.dot(along) - low) / extent;
    least = std::min(least, axis.place[i]);
    most = std::max(most, axis.place[i]);
  }
  constexpr int n = LinearGradient::kPlaces;
  axis.first = std::clamp(static_cast<int>(std::floor(least * n + 0.3)), 0, n - 1);
  axis.last = std::clamp(static_cast<int>(std::ceil(most * n - 0.3)), axis.first + 1, n);
  for (double& place : axis.place) place = (place * n - axis.first) / (axis.last - axis.first);
  return axis;
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
