#include <cmath>

#include "quadrille/quad_mesh.h"

namespace quadrille {
namespace {

/// Walks the border with the mesh on its left-hand side and checks that it is one loop which runs
/// along the rectangle's sides in order and turns only at its corners.
void check_border(const QuadMesh& mesh, double width, double height,
                  std::vector<MeshViolation>& found) {
  int border_count = 0, start = -1;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) >= 0) continue;
    ++border_count;
    if (mesh.vertices[mesh.origin(h)] == Eigen::Vector2d(0, 0)) start = h;
  }
  if (start < 0) {
    found.push_back({"border", -1, 0});
    return;
  }
  const Eigen::Vector2d corners[4] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  int h = start, side = 0, steps = 0;
  do {
    const Eigen::Vector2d p = mesh.vertices[mesh.origin(h)], q = mesh.vertices[mesh.tip(h)];
    const Eigen::Vector2d a = corners[side & 3], b = corners[(side + 1) & 3];
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d offset = q - a;
    if (offset.x() * along.y() - offset.y() * along.x() != 0 || (q - p).dot(along) <= 0) {
      found.push_back({"border", mesh.tip(h), (q - p).dot(along)});
      return;
    }
    if (q == b) ++side;
    h = mesh.fan(mesh.tip(h)).front();
    ++steps;
  } while (h != start && steps <= border_count);
  if (side != 4 || steps != border_count) {
    found.push_back({"border", -1, static_cast<double>(border_count - steps)});
  }
}

}  // namespace

std::vector<MeshViolation> validate(const QuadMesh& mesh, double width, double height) {
  std::vector<MeshViolation> found;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.vertices[v].allFinite()) found.push_back({"not finite", v, 0});
  }
  if (!found.empty()) return found;

  const int euler = mesh.vertex_count() - mesh.edge_count() + mesh.quad_count();
  if (euler != 1) found.push_back({"euler", -1, static_cast<double>(euler)});
  check_border(mesh, width, height, found);

  double area = 0;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    area += quad_area(mesh, q);
    const double sine = scaled_jacobian(mesh, q);
    if (!(sine > 0)) found.push_back({"corner", q, sine});
  }
  if (!(std::abs(area - width * height) <= 1e-9 * width * height)) {
    found.push_back({"area", -1, area});
  }
  return found;
}

}  // namespace quadrille
