#include "paint_groups.h"

#include <algorithm>
#include <utility>

#include "quadrille/disjoint_sets.h"

namespace quadrille {
namespace {

/// True when the edge of half-edge h parts two painted patches by a tear.
bool parts(const QuadMesh& mesh, const std::vector<char>& painted, int h) {
  const int twin = mesh.twin(h);
  return twin >= 0 && mesh.is_tear(mesh.edge(h)) && painted[QuadMesh::quad_of(h)] &&
         painted[QuadMesh::quad_of(twin)];
}

/// Numbers of the sectors into which tears divide the fan of a vertex, one per half-edge.
std::vector<int> sectors_around(const QuadMesh& mesh, int vertex) {
  const auto fan = mesh.fan(vertex);
  const auto begins = [&](int h) { return mesh.is_tear(mesh.edge(h)); };
  std::vector<int> sectors(1, 0);
  for (const int h : fan.subspan(1)) sectors.push_back(sectors.back() + begins(h));
  const bool goes_around = !mesh.is_border_vertex(vertex) && !begins(fan.front());
  const int last = sectors.back();
  if (goes_around) std::replace(sectors.begin(), sectors.end(), last, 0);
  return sectors;
}

/// Leaves patches of a lower group out of the inside of a region where they meet the group, which
/// has the `touched` vertices, across tears at a corner alone: paint that goes on beyond the end of
/// a side would show on them.
void leave_out_across_tears(const QuadMesh& mesh, const PaintGroups& groups, int group,
                            const std::vector<char>& touched, std::vector<char>& inside) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto fan = mesh.fan(v);
    const auto is_torn = [&](int h) { return mesh.is_tear(mesh.edge(h)); };
    if (!touched[v] || std::none_of(fan.begin(), fan.end(), is_torn)) continue;
    const std::vector<int> sectors = sectors_around(mesh, v);
    std::vector<char> has_group(sectors.size(), 0);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      if (groups.group[QuadMesh::quad_of(fan[i])] == group) has_group[sectors[i]] = 1;
    }
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const int quad = QuadMesh::quad_of(fan[i]), its = groups.group[quad];
      const bool is_lower = its < group && (its >= 0 || !groups.open_unpainted);
      if (is_lower && !has_group[sectors[i]]) inside[quad] = 0;
    }
  }
}

/// Patches that follow each other around a vertex of a tear, without one between them, belong on
/// the same side of it. At a tear's end inside the picture the two sides may differ.
DisjointSets sides_of_tears(const QuadMesh& mesh, const std::vector<char>& painted) {
  DisjointSets sets(mesh.quad_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto fan = mesh.fan(v);
    int tears = 0;
    for (const int h : fan) tears += parts(mesh, painted, h);
    if (tears == 0 || (tears == 1 && !mesh.is_border_vertex(v))) continue;
    for (const int h : fan) {
      const int twin = mesh.twin(h);
      if (twin < 0 || mesh.is_tear(mesh.edge(h))) continue;
      const int a = QuadMesh::quad_of(h), b = QuadMesh::quad_of(twin);
      if (painted[a] && painted[b]) sets.unite(a, b);
    }
  }
  return sets;
}

}  // namespace

PaintGroups paint_groups(const QuadMesh& mesh, const std::vector<char>& painted,
                         const std::vector<char>& paintable) {
  DisjointSets sets = sides_of_tears(mesh, painted);
  std::vector<std::pair<int, int>> neighbours;  // sets on the two sides of a tear
  std::vector<int> size(mesh.quad_count(), 0);
  for (int q = 0; q < mesh.quad_count(); ++q) ++size[sets.find(q)];
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (!parts(mesh, painted, h)) continue;
    neighbours.emplace_back(sets.find(QuadMesh::quad_of(h)),
                            sets.find(QuadMesh::quad_of(mesh.twin(h))));
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());

  // The largest sets come first: most patches then need no region.
  std::vector<int> order;
  for (const auto& [set, other] : neighbours) {
    if (order.empty() || order.back() != set) order.push_back(set);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
  std::vector<int> group_of_set(mesh.quad_count(), PaintGroups::kUnpainted);
  for (const int set : order) {
    std::vector<char> taken;
    const auto begin = std::lower_bound(neighbours.begin(), neighbours.end(), std::pair(set, -1));
    for (auto it = begin; it != neighbours.end() && it->first == set; ++it) {
      const int other = group_of_set[it->second];
      if (other < 0) continue;
      taken.resize(std::max<std::size_t>(taken.size(), other + 1));
      taken[other] = 1;
    }
    group_of_set[set] = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
  }

  PaintGroups groups;
  groups.group.assign(mesh.quad_count(), PaintGroups::kUnpainted);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (!painted[q]) {
      if (!paintable.empty() && !paintable[q]) groups.group[q] = PaintGroups::kUnpaintable;
      continue;
    }
    groups.group[q] = std::max(group_of_set[sets.find(q)], 0);
    groups.count = std::max(groups.count, groups.group[q] + 1);
  }
  return groups;
}

Across across(const QuadMesh& mesh, const PaintGroups& groups, int h) {
  const int twin = mesh.twin(h);
  if (twin < 0) return groups.open_border ? Across::open : Across::outside;
  const int mine = groups.group[QuadMesh::quad_of(h)];
  const int its = groups.group[QuadMesh::quad_of(twin)];
  const bool torn = mesh.is_tear(mesh.edge(h));
  if (mine == its) return torn ? Across::tangled : Across::same;
  if (its > mine) return Across::open;
  if (!torn && its != PaintGroups::kUnpaintable) return Across::smooth;
  const bool open = its < 0 && groups.open_unpainted;
  return open ? Across::open : Across::outside;
}

std::vector<EdgeLoop> border_of(const QuadMesh& mesh, const std::vector<char>& inside) {
  const auto on_border = [&](int h) {
    const int twin = mesh.twin(h);
    return inside[QuadMesh::quad_of(h)] && (twin < 0 || !inside[QuadMesh::quad_of(twin)]);
  };
  std::vector<char> seen(mesh.halfedge_count(), 0);
  std::vector<EdgeLoop> loops;
  for (int start = 0; start < mesh.halfedge_count(); ++start) {
    if (seen[start] || !on_border(start)) continue;
    EdgeLoop& loop = loops.emplace_back();
    for (int h = start; !seen[h];) {
      seen[h] = 1;
      loop.push_back(h);
      h = QuadMesh::next(h);
      while (!on_border(h)) h = QuadMesh::next(mesh.twin(h));
    }
  }
  return loops;
}

std::vector<EdgeLoop> group_region(const QuadMesh& mesh, const PaintGroups& groups, int group) {
  std::vector<char> inside(mesh.quad_count(), 0), touched(mesh.vertex_count(), 0);
  bool cuts = false;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (groups.group[QuadMesh::quad_of(h)] != group) continue;
    touched[mesh.origin(h)] = inside[QuadMesh::quad_of(h)] = 1;
    const bool ends = across(mesh, groups, h) == Across::outside;
    cuts = cuts || ends;
    const int beyond = mesh.twin(h) < 0 ? -1 : QuadMesh::quad_of(mesh.twin(h));
    const bool goes_on = !ends && beyond >= 0 && groups.group[beyond] != PaintGroups::kUnpaintable;
    if (goes_on) inside[beyond] = 1;
  }
  if (!cuts) return {};
  // Whatever hides the group hides it around its vertices, too.
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const int quad = QuadMesh::quad_of(h);
    if (groups.group[quad] > group && touched[mesh.origin(h)]) inside[quad] = 1;
  }
  // A patch may lie smoothly beside some of the group and across a tear from others.
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const bool ends = groups.group[QuadMesh::quad_of(h)] == group &&
                      across(mesh, groups, h) == Across::outside && mesh.twin(h) >= 0;
    if (ends) inside[QuadMesh::quad_of(mesh.twin(h))] = 0;
  }
  leave_out_across_tears(mesh, groups, group, touched, inside);
  return border_of(mesh, inside);
}

}  // namespace quadrille
