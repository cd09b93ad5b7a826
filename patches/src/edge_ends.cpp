#include "edge_ends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quadrille {
namespace {

constexpr double kCosine45 = 0.70710678118654752;

/// Minus the cosine of the angle between the chords of two ends at one vertex: 1 when one runs
/// straight on from the other.
double straightness(const QuadMesh& mesh, int a, int b) {
  const Eigen::Vector2d origin = mesh.vertices[vertex_at(mesh, a)];
  const Eigen::Vector2d p = mesh.vertices[vertex_at(mesh, a ^ 1)] - origin;
  const Eigen::Vector2d q = mesh.vertices[vertex_at(mesh, b ^ 1)] - origin;
  const double lengths = p.norm() * q.norm();
  return lengths > 0 ? -p.dot(q) / lengths : -1;
}

/// The edge ends at v in fan order; those of the border come first and last.
void collect_ends(const QuadMesh& mesh, int v, std::vector<int>& ends) {
  ends.clear();
  for (const int h : mesh.fan(v)) ends.push_back(edge_end(mesh, h, 0));
  if (mesh.is_border_vertex(v)) {
    ends.push_back(edge_end(mesh, QuadMesh::prev(mesh.fan(v).back()), 1));
  }
}

/// The border edge end that meets border edge end `end` at its vertex.
int other_border_end(const QuadMesh& mesh, int end) {
  const auto fan = mesh.fan(vertex_at(mesh, end));
  const int first = edge_end(mesh, fan.front(), 0);
  return first == end ? edge_end(mesh, QuadMesh::prev(fan.back()), 1) : first;
}

bool runs_straight(const QuadMesh& mesh, int a, int b) {
  const Eigen::Vector2d origin = mesh.vertices[vertex_at(mesh, a)];
  const Eigen::Vector2d p = mesh.vertices[vertex_at(mesh, a ^ 1)] - origin;
  const Eigen::Vector2d q = mesh.vertices[vertex_at(mesh, b ^ 1)] - origin;
  return p.x() * q.y() == p.y() * q.x() && p.dot(q) < 0;
}

/// True when the border runs from end a to end b as one curve: not around a corner, and not where a
/// straight piece of two edges or more, such as a side of the picture, would be bent by what
/// follows it.
bool is_one_border_curve(const QuadMesh& mesh, int a, int b) {
  if (runs_straight(mesh, a, b)) return true;
  return straightness(mesh, a, b) > kCosine45 &&
         !runs_straight(mesh, a ^ 1, other_border_end(mesh, a ^ 1)) &&
         !runs_straight(mesh, b ^ 1, other_border_end(mesh, b ^ 1));
}

/// True when the i-th and the j-th of n ends at a vertex bound the same quad.
bool are_neighbours(std::size_t i, std::size_t j, std::size_t n, bool closed) {
  return j - i == 1 || (closed && i == 0 && j + 1 == n);
}

/// What may pair with what: ends of a chain of tears continue each other, then ends of features,
/// then a tear goes on as a feature; other edges keep to themselves.
enum class EndKind { plain, feature, tear };

EndKind kind_of(const QuadMesh& mesh, int end) {
  const std::uint8_t flags = mesh.edge_flags[end >> 1];
  return flags & kTearEdge      ? EndKind::tear
         : flags & kFeatureEdge ? EndKind::feature
                                : EndKind::plain;
}

/// Pairs the ends inside for which may_pair(a, b) holds and that have no partner yet, the
/// straightest pair first; earlier ends win ties. The two sides of a quad's corner are no pair: a
/// common tangent would fold the corner. Nor is a border edge with one inside, which would bend the
/// border.
template <class MayPair>
void pair_straightest(const QuadMesh& mesh, const std::vector<int>& ends, bool closed,
                      std::vector<int>& opposite, const MayPair& may_pair) {
  const std::size_t first_inside = closed ? 0 : 1;
  const std::size_t end_inside = closed ? ends.size() : ends.size() - 1;
  while (true) {
    double best = kCosine45;
    std::size_t first = 0, second = 0;
    for (std::size_t i = first_inside; i < end_inside; ++i) {
      for (std::size_t j = i + 1; j < end_inside; ++j) {
        if (opposite[ends[i]] >= 0 || opposite[ends[j]] >= 0) continue;
        if (are_neighbours(i, j, ends.size(), closed)) continue;
        if (!may_pair(ends[i], ends[j])) continue;
        const double s = straightness(mesh, ends[i], ends[j]);
        if (s > best) best = s, first = i, second = j;
      }
    }
    if (first == second) return;
    opposite[ends[first]] = ends[second];
    opposite[ends[second]] = ends[first];
  }
}

/// Pairs the ends of contours at a vertex.
void pair_contours(const QuadMesh& mesh, const std::vector<int>& ends, bool closed,
                   std::vector<int>& opposite) {
  const auto both = [&](EndKind kind) {
    return [&mesh, kind](int a, int b) {
      return kind_of(mesh, a) == kind && kind_of(mesh, b) == kind;
    };
  };
  const auto mixed = [&](int a, int b) {
    return kind_of(mesh, a) != EndKind::plain && kind_of(mesh, b) != EndKind::plain;
  };
  pair_straightest(mesh, ends, closed, opposite, both(EndKind::tear));
  pair_straightest(mesh, ends, closed, opposite, both(EndKind::feature));
  pair_straightest(mesh, ends, closed, opposite, mixed);
}

}  // namespace

std::vector<int> opposite_ends(const QuadMesh& mesh) {
  std::vector<int> opposite(2 * static_cast<std::size_t>(mesh.edge_count()), -1);
  std::vector<int> ends;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    collect_ends(mesh, v, ends);
    const bool closed = !mesh.is_border_vertex(v);
    const auto is_plain = [&](int end) { return kind_of(mesh, end) == EndKind::plain; };
    pair_contours(mesh, ends, closed, opposite);
    if (closed && ends.size() == 4) {
      for (int i = 0; i < 4; ++i) {
        const int other = ends[(i + 2) & 3];
        if (is_plain(ends[i]) && is_plain(other)) opposite[ends[i]] = other;
      }
      continue;
    }
    if (!closed && ends.size() >= 3 && is_one_border_curve(mesh, ends.front(), ends.back())) {
      opposite[ends.front()] = ends.back();
      opposite[ends.back()] = ends.front();
    }
    pair_straightest(mesh, ends, closed, opposite,
                     [&](int a, int b) { return is_plain(a) && is_plain(b); });
  }
  return opposite;
}

}  // namespace quadrille
