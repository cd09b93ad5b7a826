#include "vtk_display_colors.h"

#include <Eigen/Core>
#include <algorithm>

namespace quadrille {
namespace {

using Eigen::Array4d;

constexpr int kSamples = 8;  ///< per parameter direction

/// Numbers of the points in VTK's cell, by row and column of the control net.
constexpr int kNet[4][4] = {{0, 4, 5, 1}, {10, 12, 13, 6}, {11, 14, 15, 7}, {3, 8, 9, 2}};
/// The four edges of a cell, each with its ends outside.
constexpr int kEdges[4][4] = {{0, 4, 5, 1}, {1, 6, 7, 2}, {3, 8, 9, 2}, {0, 10, 11, 3}};

/// Cubic Bernstein polynomials at the sample parameters.
const Eigen::Matrix<double, kSamples, 4>& bernstein() {
  static const auto basis = [] {
    Eigen::Matrix<double, kSamples, 4> b;
    for (int i = 0; i < kSamples; ++i) {
      const double t = (i + 0.5) / kSamples, s = 1 - t;
      b.row(i) << s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t;
    }
    return b;
  }();
  return basis;
}

/// What is shown for a premultiplied colour.
Array4d shown(const Array4d& c) {
  const double alpha = std::clamp(c[3], 0.0, 1.0);
  Array4d straight = Array4d::Zero();
  if (alpha > 0) straight = (c / alpha).cwiseMax(0).cwiseMin(1);
  straight[3] = alpha;
  return straight;
}

/// x in [0, 1]^n that minimises sum w_i (row_i x - target_i)^2 by projected Gauss-Seidel.
template <int N, int M>
void fit_bounded(const Eigen::Matrix<double, M, N>& rows, const Eigen::Matrix<double, M, 1>& target,
                 const Eigen::Matrix<double, M, 1>& weight, Eigen::Matrix<double, N, 1>& x) {
  const Eigen::Matrix<double, N, M> weighted = rows.transpose() * weight.asDiagonal();
  const Eigen::Matrix<double, N, N> normal = weighted * rows;
  const Eigen::Matrix<double, N, 1> right = weighted * target;
  constexpr int kSweeps = 60;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int k = 0; k < N; ++k) {
      if (normal(k, k) <= 0) continue;
      x[k] = std::clamp(x[k] + (right[k] - normal.row(k).dot(x)) / normal(k, k), 0.0, 1.0);
    }
  }
}

/// Weights of the samples for a channel: a colour counts as much as one sees of it.
template <int M>
Eigen::Matrix<double, M, 1> sample_weights(const Eigen::Matrix<double, M, 4>& target, int channel) {
  if (channel == 3) return Eigen::Matrix<double, M, 1>::Ones();
  return target.col(3);
}

class DisplayColors {
 public:
  explicit DisplayColors(const ControlPoints& points)
      : points_(points), value_(points.color.size()), final_(points.color.size()) {
    for (std::size_t i = 0; i < value_.size(); ++i) value_[i] = shown(exact(i));
  }

  std::vector<std::array<std::uint8_t, 4>> run() {
    for (const auto& cell : points_.cells) {
      for (const auto& edge : kEdges) fit_edge(cell, edge);
      fit_inside(cell);
    }
    std::vector<std::array<std::uint8_t, 4>> bytes(value_.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (int c = 0; c < 4; ++c) bytes[i][c] = static_cast<std::uint8_t>(value_[i][c] * 255 + 0.5);
    }
    return bytes;
  }

 private:
  using Cell = std::array<int, 16>;

  Array4d exact(int point) const { return points_.color[point].cast<double>(); }

  /// True when the control values themselves can be shown.
  bool in_range(int point) const {
    const Color& c = points_.color[point];
    return c[3] == 1 && (c >= 0).all() && (c <= 1).all();
  }

  /// The first cell at an edge decides the two points inside it, the second finds them decided.
  void fit_edge(const Cell& cell, const int (&edge)[4]) {
    const int ids[4] = {cell[edge[0]], cell[edge[1]], cell[edge[2]], cell[edge[3]]};
    if (std::all_of(ids, ids + 4, [&](int id) { return in_range(id); })) return;
    Eigen::Matrix<double, kSamples, 4> target, known;
    for (int i = 0; i < kSamples; ++i) {
      Array4d sum = Array4d::Zero();
      for (int k = 0; k < 4; ++k) sum += exact(ids[k]) * bernstein()(i, k);
      target.row(i) = shown(sum);
      known.row(i) = value_[ids[0]] * bernstein()(i, 0) + value_[ids[3]] * bernstein()(i, 3);
    }
    const Eigen::Matrix<double, kSamples, 2> rows = bernstein().middleCols<2>(1);
    for (int c = 0; c < 4; ++c) {
      Eigen::Vector2d x(value_[ids[1]][c], value_[ids[2]][c]);
      fit_bounded<2, kSamples>(rows, target.col(c) - known.col(c), sample_weights(target, c), x);
      for (int k = 0; k < 2; ++k) {
        if (!final_[ids[k + 1]]) value_[ids[k + 1]][c] = x[k];
      }
    }
    final_[ids[1]] = final_[ids[2]] = true;
  }

  void fit_inside(const Cell& cell) {
    if (std::all_of(cell.begin(), cell.end(), [&](int id) { return in_range(id); })) return;
    constexpr int kAll = kSamples * kSamples;
    Eigen::Matrix<double, kAll, 4> target, known, rows;
    for (int b = 0; b < kSamples; ++b) {
      for (int a = 0; a < kSamples; ++a) {
        Array4d sum = Array4d::Zero(), boundary = Array4d::Zero();
        for (int j = 0; j < 4; ++j) {
          for (int i = 0; i < 4; ++i) {
            const double factor = bernstein()(b, j) * bernstein()(a, i);
            const int id = cell[kNet[j][i]];
            sum += exact(id) * factor;
            const bool inside = (j == 1 || j == 2) && (i == 1 || i == 2);
            if (inside) {
              rows(b * kSamples + a, 2 * (j - 1) + i - 1) = factor;
            } else {
              boundary += value_[id] * factor;
            }
          }
        }
        target.row(b * kSamples + a) = shown(sum);
        known.row(b * kSamples + a) = boundary;
      }
    }
    for (int c = 0; c < 4; ++c) {
      Eigen::Vector4d x;
      for (int k = 0; k < 4; ++k) x[k] = value_[cell[12 + k]][c];
      fit_bounded<4, kAll>(rows, target.col(c) - known.col(c), sample_weights(target, c), x);
      for (int k = 0; k < 4; ++k) value_[cell[12 + k]][c] = x[k];
    }
  }

  const ControlPoints& points_;
  std::vector<Array4d> value_;
  std::vector<char> final_;
};

}  // namespace

std::vector<std::array<std::uint8_t, 4>> display_colors(const ControlPoints& points) {
  return DisplayColors(points).run();
}

}  // namespace quadrille
