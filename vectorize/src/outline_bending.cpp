#include "outline_bending.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "corner_sines.h"
#include "quadrille/mesh_region.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kSoundSine = 0.25;  // of the worst corner; below it corners must not get worse

/// The vertices that end border edges which touch or cross others.
std::vector<int> conflicting_vertices(const QuadMesh& mesh) {
  const auto vertices = border_loops(mesh);
  std::vector<Loop> loops;
  for (const auto& loop : vertices) {
    Loop& points = loops.emplace_back();
    for (const int v : loop) points.push_back(mesh.vertices[v]);
  }
  std::vector<int> found;
  for (const auto& pair : conflicts(loops)) {
    for (const auto& [loop, index] : pair) {
      const auto& all = vertices[loop];
      found.push_back(all[index]);
      found.push_back(all[(index + 1) % all.size()]);
    }
  }
  return found;
}

}  // namespace

void bend_outline(QuadMesh& mesh, const OutlineSamples& outline) {
  using Ends = std::array<double, 4>;
  const auto ends = [](const Vector2d& a, const Vector2d& b) -> Ends {
    return {a.x(), a.y(), b.x(), b.y()};
  };
  std::map<Ends, Vector2d> target;
  for (int p = 0; p < static_cast<int>(outline.points.size()); ++p) {
    target[ends(outline.points[p], outline.points[outline.next(p)])] = outline.midpoints[p];
  }
  std::map<int, Vector2d> moved_from;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_border_vertex(v)) continue;
    const auto fan = mesh.fan(v);
    const Vector2d &next = mesh.vertices[mesh.tip(fan.front())],
                   &before = mesh.vertices[mesh.origin(QuadMesh::prev(fan.back()))];
    const auto found = target.find(ends(before, next));
    if (found == target.end()) continue;
    const Vector2d chord_middle = mesh.vertices[v];
    moved_from[v] = chord_middle;
    const double least = std::min(smallest_sine_around(mesh, v), kSoundSine);
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
      mesh.vertices[v] = chord_middle + share * (found->second - chord_middle);
      if (smallest_sine_around(mesh, v) >= least) break;
    }
  }
  // Strands of the outline that nearly touch may cross where one is bent and the other is not.
  // Unbent all chords are apart, so this ends.
  while (!moved_from.empty()) {
    std::size_t unbent = 0;
    for (const int v : conflicting_vertices(mesh)) {
      const auto at = moved_from.find(v);
      if (at == moved_from.end()) continue;
      mesh.vertices[v] = at->second;
      moved_from.erase(at);
      ++unbent;
    }
    if (unbent == 0) return;
  }
}

}  // namespace quadrille
