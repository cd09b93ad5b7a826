#include <array>
#include <cmath>

#include "quadrille/tears.h"

namespace quadrille {
namespace {

constexpr double kCosine45 = 0.7071067811865476;

class ChainFinder {
 public:
  explicit ChainFinder(const QuadMesh& mesh)
      : mesh_(mesh), edges_at_(mesh.vertex_count()), is_taken_(mesh.edge_count(), 0) {
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (!is_feature(e)) continue;
      for (const int v : ends(e)) edges_at_[v].push_back(e);
    }
  }

  std::vector<std::vector<int>> chains() {
    std::vector<std::vector<int>> found;
    // Those with ends first, then closed ones.
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (continues(v)) continue;
      for (const int e : edges_at_[v]) {
        if (!is_taken_[e]) found.push_back(follow(v, e));
      }
    }
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      if (is_feature(e) && !is_taken_[e]) found.push_back(follow(ends(e)[0], e));
    }
    return found;
  }

 private:
  const QuadMesh& mesh_;
  std::vector<std::vector<int>> edges_at_;  // feature edges per vertex
  std::vector<char> is_taken_;

  bool is_feature(int e) const { return mesh_.edge_flags[e] & kFeatureEdge && !mesh_.is_border(e); }
  std::array<int, 2> ends(int e) const {
    const int h = mesh_.halfedge(e);
    return {mesh_.origin(h), mesh_.tip(h)};
  }
  int other_end(int e, int v) const { return ends(e)[0] == v ? ends(e)[1] : ends(e)[0]; }

  bool continues(int v) const {
    if (edges_at_[v].size() != 2) return false;
    const Eigen::Vector2d in = mesh_.vertices[v] - mesh_.vertices[other_end(edges_at_[v][0], v)];
    const Eigen::Vector2d out = mesh_.vertices[other_end(edges_at_[v][1], v)] - mesh_.vertices[v];
    return in.dot(out) > kCosine45 * in.norm() * out.norm();
  }

  std::vector<int> follow(int v, int e) {
    std::vector<int> chain;
    while (!is_taken_[e]) {
      is_taken_[e] = 1;
      chain.push_back(e);
      v = other_end(e, v);
      if (!continues(v)) break;
      e = edges_at_[v][0] == e ? edges_at_[v][1] : edges_at_[v][0];
    }
    return chain;
  }
};

}  // namespace

std::vector<std::vector<int>> feature_edge_chains(const QuadMesh& mesh) {
  return ChainFinder(mesh).chains();
}

}  // namespace quadrille
