#include "shape_smoothing.h"

#include <algorithm>

namespace quadrille {
namespace {

constexpr double kGoodEnough = 0.55;  // corner sine above which a quad is left alone
constexpr int kRounds = 12;

double smallest_sine_around(const QuadMesh& mesh, int v) {
  double smallest = 1;
  for (const int h : mesh.fan(v)) smallest = std::min(smallest, scaled_jacobian(mesh, h >> 2));
  return smallest;
}

Eigen::Vector2d mean_of_neighbours(const QuadMesh& mesh, int v) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const auto fan = mesh.fan(v);
  for (const int h : fan) sum += mesh.vertices[mesh.tip(h)];
  return sum / static_cast<double>(fan.size());
}

Eigen::Vector2d mean_of_diagonals(const QuadMesh& mesh, int v) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const auto fan = mesh.fan(v);
  for (const int h : fan) sum += mesh.vertices[mesh.tip(QuadMesh::next(h))];
  return sum / static_cast<double>(fan.size());
}

/// Keeps a border vertex on its side of the picture; elsewhere on the border, and at corners,
/// nothing moves.
Eigen::Vector2d allowed_step(const QuadMesh& mesh, int v, const Eigen::Vector2d& step, double width,
                             double height) {
  if (!mesh.is_border_vertex(v)) return step;
  const auto fan = mesh.fan(v);
  const Eigen::Vector2d &p = mesh.vertices[v], &next = mesh.vertices[mesh.tip(fan.front())],
                        &before = mesh.vertices[mesh.origin(QuadMesh::prev(fan.back()))];
  const double size[2] = {width, height};
  for (int axis = 0; axis < 2; ++axis) {
    const bool on_side = p[axis] == 0 || p[axis] == size[axis];
    if (!on_side || next[axis] != p[axis] || before[axis] != p[axis]) continue;
    Eigen::Vector2d along = step;
    along[axis] = 0;
    return along;
  }
  return Eigen::Vector2d::Zero();
}

bool improve(QuadMesh& mesh, int v, double before, double width, double height) {
  const Eigen::Vector2d p = mesh.vertices[v];
  for (const Eigen::Vector2d& target : {mean_of_neighbours(mesh, v), mean_of_diagonals(mesh, v)}) {
    const Eigen::Vector2d step = allowed_step(mesh, v, target - p, width, height);
    if (step.isZero()) continue;
    for (const double share : {1.0, 0.5, 0.2}) {
      mesh.vertices[v] = p + share * step;
      if (smallest_sine_around(mesh, v) > before + 1e-3) return true;
    }
  }
  mesh.vertices[v] = p;
  return false;
}

}  // namespace

void smooth_bad_quads(QuadMesh& mesh, double width, double height) {
  for (int round = 0; round < kRounds; ++round) {
    bool moved = false;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const double before = smallest_sine_around(mesh, v);
      if (before < kGoodEnough) moved = improve(mesh, v, before, width, height) || moved;
    }
    if (!moved) return;
  }
}

}  // namespace quadrille
