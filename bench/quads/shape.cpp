#include "shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "quadrille/feature_tensor.h"

namespace quadrille::bench {
namespace {

constexpr double kReach = 1.0;  // pixels
constexpr double kAngle = 15 * std::numbers::pi / 180;

double side_length(const QuadMesh& mesh, int h) {
  return (mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)]).norm();
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d side = b - a;
  const double t = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (p - a - t * side).norm();
}

/// Marks the feature pixels that the mesh's side from a to b follows.
void mark_followed(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                   const FeatureTensor& features, FieldGrid<unsigned char>& followed) {
  const Eigen::Vector2d direction = (b - a).normalized();
  const Eigen::Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b);
  const int x_end = std::min<int>(followed.width - 1, high.x() + kReach);
  const int y_end = std::min<int>(followed.height - 1, high.y() + kReach);
  for (int y = std::max(0, static_cast<int>(low.y() - kReach)); y <= y_end; ++y) {
    for (int x = std::max(0, static_cast<int>(low.x() - kReach)); x <= x_end; ++x) {
      if (!features.edges(x, y)) continue;
      if (distance_to_segment({x + 0.5, y + 0.5}, a, b) > kReach) continue;
      const Eigen::Vector2d across = features.gradient(x, y).cast<double>().normalized();
      if (std::abs(across.dot(direction)) <= std::sin(kAngle)) followed(x, y) = 1;
    }
  }
}

double irregular_share(const QuadMesh& mesh) {
  int interior = 0, irregular = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_border_vertex(v)) continue;
    ++interior;
    irregular += mesh.valence(v) != 4;
  }
  return interior ? static_cast<double>(irregular) / interior : 0;
}

double mean_of(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

}  // namespace

double anisotropy(const QuadMesh& mesh, int quad) {
  const double u = side_length(mesh, 4 * quad) + side_length(mesh, 4 * quad + 2);
  const double v = side_length(mesh, 4 * quad + 1) + side_length(mesh, 4 * quad + 3);
  return std::max(u, v) / std::min(u, v);
}

ShapeStatistics shape_statistics(const QuadMesh& mesh) {
  std::vector<double> jacobians, anisotropies;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    jacobians.push_back(scaled_jacobian(mesh, q));
    anisotropies.push_back(anisotropy(mesh, q));
  }
  std::ranges::sort(jacobians);
  ShapeStatistics shape;
  shape.jacobian_min = jacobians.front();
  shape.jacobian_p5 = jacobians[jacobians.size() / 20];
  shape.jacobian_mean = mean_of(jacobians);
  shape.irregular_share = irregular_share(mesh);
  shape.anisotropy_mean = mean_of(anisotropies);
  shape.anisotropy_max = std::ranges::max(anisotropies);
  return shape;
}

double aligned_share(const QuadMesh& mesh, const Raster& picture) {
  const FeatureTensor features = feature_tensor(picture);
  FieldGrid<unsigned char> followed(picture.width, picture.height, 0);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    mark_followed(mesh.vertices[mesh.origin(h)], mesh.vertices[mesh.tip(h)], features, followed);
  }
  const auto count = [](const FieldGrid<unsigned char>& grid) {
    return std::ranges::count_if(grid.data, [](unsigned char marked) { return marked != 0; });
  };
  const auto wanted = count(features.edges);
  return wanted ? static_cast<double>(count(followed)) / static_cast<double>(wanted) : 1;
}

}  // namespace quadrille::bench
