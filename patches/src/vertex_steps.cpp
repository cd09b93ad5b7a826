#include "vertex_steps.h"

#include <algorithm>
#include <array>

namespace quadrille {
namespace {

constexpr double kLongestStep = 0.35;  // of the shortest edge at a vertex
/// Shares of a step that are tried one after the other.
constexpr std::array<double, 6> kShares = {1, 0.5, 0.25, 0.125, 0.0625, 0};
constexpr int kLastShare = static_cast<int>(kShares.size()) - 1;

std::vector<double> shortest_edges(const QuadMesh& mesh) {
  std::vector<double> shortest(mesh.vertex_count(), 1e300);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e), a = mesh.origin(h), b = mesh.tip(h);
    const double length = (mesh.vertices[b] - mesh.vertices[a]).norm();
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  return shortest;
}

}  // namespace

std::vector<Eigen::Vector2d> take_steps(const QuadMesh& mesh, const VertexGuides& guides,
                                        const std::vector<Eigen::Vector2f>& steps, double least) {
  const std::vector<double> shortest = shortest_edges(mesh);
  std::vector<Eigen::Vector2d> limited(mesh.vertex_count());
  QuadMesh moved = mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    limited[v] = steps[v].cast<double>();
    const double length = limited[v].norm(), most = kLongestStep * shortest[v];
    if (!(length < 1e300)) limited[v].setZero();
    if (length > most) limited[v] *= most / length;
    moved.vertices[v] = guides.moved(v, limited[v]);
  }
  std::vector<double> allowed(mesh.quad_count());
  std::vector<int> suspects(mesh.quad_count());
  for (int q = 0; q < mesh.quad_count(); ++q) {
    allowed[q] = std::min(least, scaled_jacobian(mesh, q));
    suspects[q] = q;
  }
  std::vector<char> share(mesh.vertex_count(), 0);
  while (true) {
    std::erase_if(suspects, [&](int q) { return scaled_jacobian(moved, q) >= allowed[q]; });
    if (suspects.empty()) break;
    std::vector<int> shortened;
    for (const int q : suspects) {
      for (const int v : mesh.quads()[q]) shortened.push_back(v);
    }
    std::sort(shortened.begin(), shortened.end());
    shortened.erase(std::unique(shortened.begin(), shortened.end()), shortened.end());
    std::erase_if(shortened, [&](int v) { return share[v] == kLastShare; });
    if (shortened.empty()) break;
    suspects.clear();
    for (const int v : shortened) {
      moved.vertices[v] = guides.moved(v, kShares[++share[v]] * limited[v]);
      for (const int h : mesh.fan(v)) suspects.push_back(QuadMesh::quad_of(h));
    }
    std::sort(suspects.begin(), suspects.end());
    suspects.erase(std::unique(suspects.begin(), suspects.end()), suspects.end());
  }
  return std::move(moved.vertices);
}

}  // namespace quadrille
