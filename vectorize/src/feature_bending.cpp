#include "feature_bending.h"

#include <algorithm>
#include <map>

#include "corner_sines.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kSoundSine = 0.2;  // of the worst corner; below it corners must not get worse

int edge_between(const QuadMesh& mesh, int a, int b) {
  for (const int h : mesh.fan(a)) {
    if (mesh.tip(h) == b) return mesh.edge(h);
    if (mesh.origin(QuadMesh::prev(h)) == b) return mesh.edge(QuadMesh::prev(h));
  }
  return -1;
}

}  // namespace

void bend_features(QuadMesh& mesh, const std::vector<FeatureEdge>& features,
                   const std::vector<HalvedEdge>& halved, std::vector<VertexGuide>& guides) {
  std::map<std::array<int, 2>, Vector2d> midpoint;
  for (const FeatureEdge& edge : features) {
    const auto [a, b] = std::minmax(edge.ends[0], edge.ends[1]);
    midpoint[{a, b}] = edge.midpoint;
  }
  for (const HalvedEdge& edge : halved) {
    const auto [a, middle, b] = edge.path;
    if (mesh.is_border_vertex(middle)) continue;  // a chain's chord along a side of the picture
    const Vector2d start = mesh.vertices[middle];
    const Vector2d target = midpoint.at(edge.ends);
    const double least = std::min(smallest_sine_around(mesh, middle), kSoundSine);
    for (const double share : {1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.25, 0.0}) {
      mesh.vertices[middle] = start + share * (target - start);
      if (smallest_sine_around(mesh, middle) >= least) break;
    }
    for (const int v : edge.path) guides[v] = VertexGuide::at(mesh.vertices[v]);
    for (const int end : {a, b}) {
      mesh.edge_flags[edge_between(mesh, end, middle)] |= kFeatureEdge;
    }
  }
}

}  // namespace quadrille
