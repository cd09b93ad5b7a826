#include "length_smoothing.h"

#include <algorithm>
#include <array>
#include <vector>

namespace quadrille {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kTolerance = 1e-2;  // of the residual; lengths need no more digits
// How fast the weight of a neighbour falls as it leaves the axis: cos^8 keeps the coupling along
// one axis apart from that along the other on a grid of eight directions.
constexpr int kHalfSharpness = 4;
// The field's turn beside a singularity is no curvature that a lattice could follow: at most this
// much per reach.
constexpr float kMaxTurn = 1.0f;

using Values = std::vector<std::array<float, 2>>;  // log lengths along x and y

/// The wished jump of both lengths between two neighbours, and what it weighs.
struct Link {
  int from, to;
  bool swapped;
  float weight[2], jump[2];
};

float power(float base, int exponent) {
  float result = 1;
  for (int k = 0; k < exponent; ++k) result *= base;
  return result;
}

FieldGrid<Eigen::Vector2f> angle_gradient(const FieldGrid<std::complex<float>>& z, float limit) {
  FieldGrid<Eigen::Vector2f> gradient(z.width, z.height);
  const auto turn = [&](int x0, int y0, int x1, int y1) {
    return 0.25f * std::arg(z(x1, y1) * std::conj(z(x0, y0)));
  };
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) {
      const int left = std::max(0, x - 1), right = std::min(z.width - 1, x + 1);
      const int up = std::max(0, y - 1), down = std::min(z.height - 1, y + 1);
      Eigen::Vector2f g(0, 0);
      if (right > left) g.x() = (turn(left, y, x, y) + turn(x, y, right, y)) / (right - left);
      if (down > up) g.y() = (turn(x, up, x, y) + turn(x, y, x, down)) / (down - up);
      const float size = g.norm();
      gradient(x, y) = size > limit ? Eigen::Vector2f(g * (limit / size)) : g;
    }
  }
  return gradient;
}

std::vector<Link> links(const CoarseMetric& metric, float reach) {
  constexpr int kSteps[4][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
  const int w = metric.z.width, h = metric.z.height;
  const FieldGrid<Eigen::Vector2f> gradient = angle_gradient(metric.z, kMaxTurn / reach);
  std::vector<Link> result;
  result.reserve(4 * metric.z.data.size());
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      for (const auto& [dx, dy] : kSteps) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || nx >= w || ny >= h) continue;
        const CrossMatching matching(metric.angle(x, y), metric.angle(nx, ny));
        const float angle = metric.angle(x, y) + 0.5f * matching.turn;
        const Eigen::Vector2f axis(std::cos(angle), std::sin(angle)), normal(-axis.y(), axis.x());
        const Eigen::Vector2f step(dx, dy);
        const float length2 = step.squaredNorm();
        const float along = step.dot(axis), across = step.dot(normal);
        const Eigen::Vector2f turn = 0.5f * (gradient(x, y) + gradient(nx, ny));
        result.push_back(
            {y * w + x,
             ny * w + nx,
             matching.swapped,
             {reach * reach / length2 * power(across * across / length2, kHalfSharpness),
              reach * reach / length2 * power(along * along / length2, kHalfSharpness)},
             {-across * turn.dot(axis), along * turn.dot(normal)}});
      }
    }
  }
  return result;
}

/// (identity + links) times v.
Values times(const std::vector<Link>& links, const Values& v) {
  Values result = v;
  for (const Link& link : links) {
    for (int axis = 0; axis < 2; ++axis) {
      const int other = axis ^ static_cast<int>(link.swapped);
      const float flow = link.weight[axis] * (v[link.from][axis] - v[link.to][other]);
      result[link.from][axis] += flow;
      result[link.to][other] -= flow;
    }
  }
  return result;
}

double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i][0] * b[i][0] + a[i][1] * b[i][1];
  return sum;
}

}  // namespace

void smooth_lengths(CoarseMetric& metric, double reach, const RunContext& context) {
  const std::vector<Link> graph = links(metric, static_cast<float>(reach));
  const std::size_t n = metric.lengths.data.size();
  Values x(n), b(n), diagonal(n, {1, 1});
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = b[i] = {metric.lengths.data[i].x, metric.lengths.data[i].y};
  }
  for (const Link& link : graph) {
    for (int axis = 0; axis < 2; ++axis) {
      const int other = axis ^ static_cast<int>(link.swapped);
      diagonal[link.from][axis] += link.weight[axis];
      diagonal[link.to][other] += link.weight[axis];
      b[link.from][axis] -= link.weight[axis] * link.jump[axis];
      b[link.to][other] += link.weight[axis] * link.jump[axis];
    }
  }

  Values residual = times(graph, x);
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < 2; ++a) residual[i][a] = b[i][a] - residual[i][a];
  }
  const double target = kTolerance * kTolerance * dot(residual, residual);
  Values direction(n, {0, 0}), corrected(n);
  double previous = 0;
  for (int k = 0; k < kMaxIterations && dot(residual, residual) > target; ++k) {
    context.progress("scale field", static_cast<double>(k) / kMaxIterations);
    for (std::size_t i = 0; i < n; ++i) {
      for (int a = 0; a < 2; ++a) corrected[i][a] = residual[i][a] / diagonal[i][a];
    }
    const double current = dot(residual, corrected);
    if (!(current > 0)) break;
    const float keep = previous > 0 ? static_cast<float>(current / previous) : 0;
    previous = current;
    for (std::size_t i = 0; i < n; ++i) {
      for (int a = 0; a < 2; ++a) direction[i][a] = corrected[i][a] + keep * direction[i][a];
    }
    const Values image = times(graph, direction);
    const float step = static_cast<float>(current / dot(direction, image));
    for (std::size_t i = 0; i < n; ++i) {
      for (int a = 0; a < 2; ++a) {
        x[i][a] += step * direction[i][a];
        residual[i][a] -= step * image[i][a];
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) metric.lengths.data[i] = {x[i][0], x[i][1]};
}

}  // namespace quadrille
