#include "patch_inverse.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

namespace quadrille {
namespace {

using Eigen::Array2d;

/// Steps are in parameters; convergence is quadratic, so the error after a step this small is far
/// below 1e-6.
constexpr double kConvergedStep = 2e-5;
constexpr int kMaxNewtonSteps = 10;
/// How far a root may lie outside the square: the outline is scanned as a polyline.
constexpr double kMargin = 0.02;

struct Evaluation {
  Array2d position, du, dv;
};

Evaluation evaluate(const PowerBasis<Array2d>& c, double u, double v) {
  Array2d row[4], row_du[4];
  for (int j = 0; j < 4; ++j) {
    const Array2d b2 = c[j][3] * u + c[j][2];
    const Array2d b1 = b2 * u + c[j][1];
    row[j] = b1 * u + c[j][0];
    row_du[j] = (c[j][3] * u + b2) * u + b1;
  }
  const Array2d b2 = row[3] * v + row[2];
  const Array2d b1 = b2 * v + row[1];
  return {b1 * v + row[0], ((row_du[3] * v + row_du[2]) * v + row_du[1]) * v + row_du[0],
          (row[3] * v + b2) * v + b1};
}

double cross(const Array2d& a, const Array2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Newton's method from uv; true when it arrived at a root in the square or within a hair of it.
/// Only roots with positive determinant count.
bool newton(const PowerBasis<Array2d>& c, const Array2d& target, Array2d& uv) {
  double u = uv.x(), v = uv.y();
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const Evaluation at = evaluate(c, u, v);
    const Array2d miss = target - at.position;
    const double determinant = cross(at.du, at.dv);
    if (!(determinant > 0)) return false;
    const double step_u = cross(miss, at.dv) / determinant;
    const double step_v = cross(at.du, miss) / determinant;
    u += step_u;
    v += step_v;
    // It may wander on the way, but a point's own root is not far out there.
    if (!(std::abs(u - 0.5) < 1 && std::abs(v - 0.5) < 1)) return false;
    if (std::abs(step_u) + std::abs(step_v) < kConvergedStep) {
      uv = {u, v};
      return std::abs(u - 0.5) < 0.5 + kMargin && std::abs(v - 0.5) < 0.5 + kMargin;
    }
  }
  return false;
}

/// Least-squares coefficients of both parameters as quadratics of the position, by Cholesky's
/// factorisation of the 6 x 6 normal matrix. A little weight on the higher coefficients keeps
/// degenerate patches solvable.
std::array<Array2d, 6> quadratic_inverse(const PowerBasis<Array2d>& c) {
  double matrix[6][6] = {};
  std::array<Array2d, 6> right;
  right.fill(Array2d::Zero());
  for (int sample = 0; sample < 9; ++sample) {
    // Chebyshev-like abscissae spread the error evenly over the square.
    constexpr double kAbscissae[3] = {0.07, 0.5, 0.93};
    const double u = kAbscissae[sample % 3], v = kAbscissae[sample / 3];
    Array2d row[4];
    for (int j = 0; j < 4; ++j) row[j] = ((c[j][3] * u + c[j][2]) * u + c[j][1]) * u + c[j][0];
    const Array2d p = ((row[3] * v + row[2]) * v + row[1]) * v + row[0];
    const double x = p.x(), y = p.y(), basis[6] = {1, x, y, x * x, x * y, y * y};
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) matrix[i][j] += basis[i] * basis[j];
      right[i] += Array2d(u, v) * basis[i];
    }
  }
  for (int i = 0; i < 6; ++i) matrix[i][i] += 1e-9;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = matrix[i][j];
      for (int k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      matrix[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / matrix[j][j];
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) right[i] -= right[k] * matrix[i][k];
    right[i] /= matrix[i][i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) right[i] -= right[k] * matrix[k][i];
    right[i] /= matrix[i][i];
  }
  return right;
}

BicubicHermite<Array2d> normalized(const BicubicHermite<Eigen::Vector2d>& h, const Array2d& center,
                                   double size) {
  BicubicHermite<Array2d> n;
  for (int k = 0; k < 4; ++k) {
    n.value[k] = (h.value[k].array() - center) / size;
    n.du[k] = h.du[k].array() / size;
    n.dv[k] = h.dv[k].array() / size;
    n.duv[k] = h.duv[k].array() / size;
  }
  return n;
}

BicubicHermite<Array2d> hermite_of(const PowerBasis<Array2d>& c) {
  BicubicHermite<Array2d> h;
  constexpr double kU[4] = {0, 1, 1, 0}, kV[4] = {0, 0, 1, 1};
  for (int k = 0; k < 4; ++k) {
    const Evaluation at = evaluate(c, kU[k], kV[k]);
    h.value[k] = at.position;
    h.du[k] = at.du;
    h.dv[k] = at.dv;
    h.duv[k] = Array2d::Zero();
    for (int j = 1; j < 4; ++j) {
      for (int i = 1; i < 4; ++i) {
        if ((kU[k] != 0 || i == 1) && (kV[k] != 0 || j == 1)) h.duv[k] += c[j][i] * double(i * j);
      }
    }
  }
  return h;
}

/// A part of the parameter square with its control points, ordered by how near it may come.
struct Cell {
  BicubicBezier<Array2d> bezier;
  double u, v, width;
  double lower_bound;  ///< of the squared distance between its positions and the target

  bool operator<(const Cell& other) const { return lower_bound > other.lower_bound; }
};

double squared_distance_to_hull_box(const BicubicBezier<Array2d>& bezier, const Array2d& target) {
  Array2d low = bezier.control[0][0], high = low;
  for (const auto& row : bezier.control) {
    for (const Array2d& p : row) low = low.min(p), high = high.max(p);
  }
  return (low - target).max(target - high).max(0.0).matrix().squaredNorm();
}

}  // namespace

NormalizedPatch::NormalizedPatch(const BicubicHermite<Eigen::Vector2d>& geometry) {
  Array2d low = geometry.value[0], high = low;
  for (const auto& p : geometry.value) low = low.min(p.array()), high = high.max(p.array());
  center = (low + high) / 2;
  size = (high - low).maxCoeff();
  if (!(size > 0)) size = 1;
  position = power_basis(normalized(geometry, center, size));
  start = quadratic_inverse(position);
}

PatchInverse::PatchInverse(const BicubicHermite<Eigen::Vector2d>& geometry) : patch_(geometry) {}

Eigen::Vector2d PatchInverse::operator()(const Eigen::Vector2d& p) const {
  const Array2d target = (p.array() - patch_.center) / patch_.size;
  const double x = target.x(), y = target.y();
  const auto& s = patch_.start;
  const Array2d guess =
      s[0] + s[1] * x + s[2] * y + s[3] * (x * x) + s[4] * (x * y) + s[5] * (y * y);
  Array2d uv = guess.max(0.0).min(1.0);
  if (newton(patch_.position, target, uv)) return uv.max(0.0).min(1.0);
  return search(target);
}

Eigen::Vector2d PatchInverse::search(const Array2d& target) const {
  constexpr int kMaxCells = 1500;
  constexpr double kSmallestWidth = 0x1p-22;
  std::priority_queue<Cell> cells;
  // Newton's method first from each cell, the likeliest first; where nothing converges the cells
  // close in on the nearest position.
  const auto push = [&](const BicubicBezier<Array2d>& b, double u, double v, double width) {
    cells.push({b, u, v, width, squared_distance_to_hull_box(b, target)});
  };
  push(to_bezier(hermite_of(patch_.position)), 0, 0, 1);

  Array2d best(0.5, 0.5);
  double best_distance = INFINITY;
  for (int count = 0; count < kMaxCells && !cells.empty(); ++count) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.lower_bound > best_distance - 1e-16 || best_distance < 1e-16) break;
    const double half = cell.width / 2;
    const Array2d middle(cell.u + half, cell.v + half);
    if (Array2d uv = middle; newton(patch_.position, target, uv)) return uv.max(0.0).min(1.0);
    const double distance = (evaluate(patch_.position, middle.x(), middle.y()).position - target)
                                .matrix()
                                .squaredNorm();
    if (distance < best_distance) best_distance = distance, best = middle;
    if (cell.width <= kSmallestWidth) continue;
    const auto left_right = cell.bezier.split_u();
    for (int i = 0; i < 2; ++i) {
      const auto top_bottom = left_right[i].split_v();
      for (int j = 0; j < 2; ++j) push(top_bottom[j], cell.u + i * half, cell.v + j * half, half);
    }
  }
  return best;
}

}  // namespace quadrille
