#include "quadrille/quad_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "quadrille/error.h"
#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

[[noreturn]] void reject(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, "not a quad mesh: " + what + "; check the connectivity");
}

}  // namespace

QuadMesh::QuadMesh(std::vector<Eigen::Vector2d> positions, std::vector<Quad> quads)
    : vertices(std::move(positions)), quads_(std::move(quads)) {
  for (int q = 0; q < quad_count(); ++q) {
    const Quad& c = quads_[q];
    for (int k = 0; k < 4; ++k) {
      if (c[k] < 0 || c[k] >= vertex_count()) {
        reject("quad " + std::to_string(q) + " refers to vertex " + std::to_string(c[k]) + " of " +
               std::to_string(vertex_count()));
      }
      for (int l = 0; l < k; ++l) {
        if (c[k] == c[l]) reject("quad " + std::to_string(q) + " repeats a vertex");
      }
    }
  }
  link_edges();
  order_fans();
  edge_flags.assign(edge_count(), 0);
}

void QuadMesh::link_edges() {
  twin_.assign(halfedge_count(), -1);
  edge_.assign(halfedge_count(), -1);
  std::unordered_map<std::uint64_t, int> first_of;
  first_of.reserve(halfedge_count());
  for (int h = 0; h < halfedge_count(); ++h) {
    const std::uint64_t a = origin(h), b = tip(h);
    const auto [it, is_new] = first_of.try_emplace(std::min(a, b) << 32 | std::max(a, b), h);
    if (is_new) {
      edge_[h] = edge_count();
      edge_halfedge_.push_back(h);
      continue;
    }
    const int g = it->second;
    if (twin_[g] >= 0 || origin(g) == origin(h)) {
      reject("the edge between vertices " + std::to_string(a) + " and " + std::to_string(b) +
             " is shared wrongly");
    }
    twin_[g] = h;
    twin_[h] = g;
    edge_[h] = edge_[g];
  }
}

void QuadMesh::order_fans() {
  const int n = vertex_count();
  fan_begin_.assign(n + 1, 0);
  for (int h = 0; h < halfedge_count(); ++h) ++fan_begin_[origin(h) + 1];
  for (int v = 0; v < n; ++v) fan_begin_[v + 1] += fan_begin_[v];

  std::vector<int> start(n, -1);
  for (int h = halfedge_count() - 1; h >= 0; --h) {
    int& s = start[origin(h)];
    if (s < 0 || twin_[s] >= 0 || twin_[h] < 0) s = h;
  }
  fan_.assign(halfedge_count(), -1);
  fan_position_.assign(halfedge_count(), -1);
  for (int v = 0; v < n; ++v) {
    if (start[v] < 0) reject("vertex " + std::to_string(v) + " belongs to no quad");
    const int size = fan_begin_[v + 1] - fan_begin_[v];
    int h = start[v];
    for (int i = 0; i < size; ++i) {
      if (h < 0 || fan_position_[h] >= 0) {
        reject("vertex " + std::to_string(v) + " joins more than one fan of quads");
      }
      fan_[fan_begin_[v] + i] = h;
      fan_position_[h] = i;
      h = twin_[prev(h)];
    }
  }
}

std::vector<int> quads_at(const QuadMesh& mesh, std::span<const int> vertices) {
  std::vector<int> found;
  for (const int v : vertices) {
    for (const int h : mesh.fan(v)) found.push_back(QuadMesh::quad_of(h));
  }
  remove_duplicates(found);
  return found;
}

std::vector<int> corners_of(const QuadMesh& mesh, std::span<const int> quads) {
  std::vector<int> found;
  for (const int q : quads) {
    found.insert(found.end(), mesh.quads()[q].begin(), mesh.quads()[q].end());
  }
  remove_duplicates(found);
  return found;
}

int count_irregular_vertices(const QuadMesh& mesh) {
  int count = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int n = mesh.valence(v);
    count += mesh.is_border_vertex(v) ? n != 3 : n != 4;
  }
  const int corners = [&] {
    int two = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      two += mesh.is_border_vertex(v) && mesh.valence(v) == 2;
    }
    return std::min(two, 4);
  }();
  return count - corners;
}

double quad_area(const QuadMesh& mesh, int q) {
  const QuadMesh::Quad& c = mesh.quads()[q];
  const Eigen::Vector2d d = mesh.vertices[c[2]] - mesh.vertices[c[0]];
  const Eigen::Vector2d e = mesh.vertices[c[3]] - mesh.vertices[c[1]];
  return 0.5 * (d.x() * e.y() - d.y() * e.x());
}

double scaled_jacobian(const QuadMesh& mesh, int q) {
  double smallest = 1;
  for (int k = 0; k < 4; ++k) {
    const int h = 4 * q + k;
    const Eigen::Vector2d p = mesh.vertices[mesh.origin(h)];
    const Eigen::Vector2d a = mesh.vertices[mesh.tip(h)] - p;
    const Eigen::Vector2d b = mesh.vertices[mesh.origin(QuadMesh::prev(h))] - p;
    const double lengths = a.norm() * b.norm();
    smallest = std::min(smallest, lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0.0);
  }
  return smallest;
}

}  // namespace quadrille
