#include "triangulation.h"

#include <deque>

namespace quadrille {
namespace {

constexpr int next_index(int k) { return k == 2 ? 0 : k + 1; }
constexpr int prev_index(int k) { return k == 0 ? 2 : k - 1; }

/// Positive when d lies inside the circle through a, b, c (positively oriented).
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  using Wide = __int128;
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x,
                     cy = c.y - d.y;
  const Wide a2 = Wide(ax) * ax + Wide(ay) * ay, b2 = Wide(bx) * bx + Wide(by) * by,
             c2 = Wide(cx) * cx + Wide(cy) * cy;
  return a2 * (Wide(bx) * cy - Wide(by) * cx) - b2 * (Wide(ax) * cy - Wide(ay) * cx) +
             c2 * (Wide(ax) * by - Wide(ay) * bx) >
         0;
}

}  // namespace

std::int64_t orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Triangulation::Triangulation(std::int64_t width, std::int64_t height)
    : points_{{0, 0}, {width, 0}, {width, height}, {0, height}},
      triangles_{{{0, 1, 2}, {-1, 1, -1}, {}}, {{0, 2, 3}, {-1, -1, 0}, {}}},
      triangle_of_{0, 0, 0, 1} {}

int Triangulation::mirrored_edge(Side side) const {
  const int other = triangles_[side.triangle].neighbour[side.edge];
  const int v = triangles_[side.triangle].vertex[next_index(side.edge)];
  const auto& vertex = triangles_[other].vertex;
  return vertex[0] == v ? 1 : vertex[1] == v ? 2 : 0;
}

void Triangulation::replace_neighbour(int t, int from, int to) {
  if (t < 0) return;
  for (int& n : triangles_[t].neighbour) {
    if (n == from) {
      n = to;
      return;
    }
  }
}

Triangulation::Side Triangulation::locate(const GridPoint& p, Place& place) const {
  int t = last_, came_from = -1;
  while (true) {
    const Triangle& triangle = triangles_[t];
    int zero = -1, zeros = 0, outward = -1;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t side = orientation(points_[triangle.vertex[next_index(k)]],
                                            points_[triangle.vertex[prev_index(k)]], p);
      if (side < 0 && triangle.neighbour[k] != came_from) outward = k;
      if (side == 0) zero = k, ++zeros;
    }
    if (outward >= 0) {
      came_from = t;
      t = triangle.neighbour[outward];
      continue;
    }
    if (zeros == 0) {
      place = Place::inside;
      return {t, 0};
    }
    if (zeros == 1) {
      place = Place::on_edge;
      return {t, zero};
    }
    place = Place::on_vertex;
    for (int k = 0; k < 3; ++k) {
      if (points_[triangle.vertex[k]] == p) return {t, k};
    }
    return {t, zero};
  }
}

int Triangulation::insert(const GridPoint& p) {
  Place place;
  const Side side = locate(p, place);
  last_ = side.triangle;
  if (place == Place::on_vertex) return triangles_[side.triangle].vertex[side.edge];
  const int v = static_cast<int>(points_.size());
  points_.push_back(p);
  triangle_of_.push_back(side.triangle);
  if (place == Place::inside) {
    split_triangle(side.triangle, v);
  } else {
    split_edge(side, v);
  }
  return v;
}

void Triangulation::split_triangle(int t, int p) {
  const Triangle old = triangles_[t];
  const int t1 = static_cast<int>(triangles_.size()), t2 = t1 + 1;
  const auto [a, b, c] = old.vertex;
  triangles_[t] = {{p, b, c}, {old.neighbour[0], t1, t2}, {old.fixed[0], false, false}};
  triangles_.push_back({{p, c, a}, {old.neighbour[1], t2, t}, {old.fixed[1], false, false}});
  triangles_.push_back({{p, a, b}, {old.neighbour[2], t, t1}, {old.fixed[2], false, false}});
  replace_neighbour(old.neighbour[1], t, t1);
  replace_neighbour(old.neighbour[2], t, t2);
  triangle_of_[p] = triangle_of_[b] = triangle_of_[c] = t;
  triangle_of_[a] = t1;
  std::vector<Side> queue{{t, 0}, {t1, 0}, {t2, 0}};
  legalise(queue);
}

void Triangulation::split_edge(Side side, int p) {
  // The triangle (apex, u, v) with p on the edge uv becomes (apex, u, p) and (apex, p, v); likewise
  // on the other side.
  const int t = side.triangle, k = side.edge;
  const Triangle old = triangles_[t];
  const int other = old.neighbour[k];
  const int apex = old.vertex[k], u = old.vertex[next_index(k)], v = old.vertex[prev_index(k)];
  const bool fixed = old.fixed[k];
  const int half = static_cast<int>(triangles_.size());
  const int other_half = other >= 0 ? half + 1 : -1;
  const int beside_v = old.neighbour[next_index(k)], beside_u = old.neighbour[prev_index(k)];
  const bool fixed_v = old.fixed[next_index(k)], fixed_u = old.fixed[prev_index(k)];

  const int mirror = other >= 0 ? mirrored_edge(side) : -1;
  triangles_[t] = {{apex, u, p}, {other_half, half, beside_u}, {fixed, false, fixed_u}};
  triangles_.push_back({{apex, p, v}, {other, beside_v, t}, {fixed, fixed_v, false}});
  replace_neighbour(beside_v, t, half);
  std::vector<Side> queue{{t, 2}, {half, 1}};
  if (other >= 0) {
    const Triangle far = triangles_[other];
    const int tip = far.vertex[mirror];
    // Its edge runs v, u; the half at v keeps the old number.
    const int far_u = far.neighbour[next_index(mirror)], far_v = far.neighbour[prev_index(mirror)];
    const bool fixed_far_u = far.fixed[next_index(mirror)];
    const bool fixed_far_v = far.fixed[prev_index(mirror)];
    triangles_[other] = {{tip, v, p}, {half, other_half, far_v}, {fixed, false, fixed_far_v}};
    triangles_.push_back({{tip, p, u}, {t, far_u, other}, {fixed, fixed_far_u, false}});
    replace_neighbour(far_u, other, other_half);
    triangle_of_[tip] = other;
    queue.push_back({other, 2});
    queue.push_back({other_half, 1});
  }
  triangle_of_[apex] = triangle_of_[u] = triangle_of_[p] = t;
  triangle_of_[v] = half;
  legalise(queue);
}

bool Triangulation::is_flippable(Side side) const {
  const Triangle& t = triangles_[side.triangle];
  const int other = t.neighbour[side.edge];
  if (other < 0) return false;
  const GridPoint &a = points_[t.vertex[side.edge]], &u = points_[t.vertex[next_index(side.edge)]],
                  &v = points_[t.vertex[prev_index(side.edge)]],
                  &d = points_[triangles_[other].vertex[mirrored_edge(side)]];
  return orientation(a, u, d) > 0 && orientation(a, d, v) > 0;
}

bool Triangulation::violates_delaunay(Side side) const {
  const Triangle& t = triangles_[side.triangle];
  const int other = t.neighbour[side.edge];
  if (other < 0 || t.fixed[side.edge]) return false;
  const GridPoint& d = points_[triangles_[other].vertex[mirrored_edge(side)]];
  return in_circle(points_[t.vertex[0]], points_[t.vertex[1]], points_[t.vertex[2]], d);
}

void Triangulation::flip(Side side) {
  const int t = side.triangle, k = side.edge;
  const int o = triangles_[t].neighbour[k], m = mirrored_edge(side);
  const Triangle old = triangles_[t], far = triangles_[o];
  const int a = old.vertex[k], u = old.vertex[next_index(k)], v = old.vertex[prev_index(k)];
  const int d = far.vertex[m];
  const int next = next_index(k), prev = prev_index(k), far_next = next_index(m),
            far_prev = prev_index(m);
  // (a, u, v) + (d, v, u) become (a, u, d) and (a, d, v).
  triangles_[t] = {{a, u, d},
                   {far.neighbour[far_next], o, old.neighbour[prev]},
                   {far.fixed[far_next], false, old.fixed[prev]}};
  triangles_[o] = {{a, d, v},
                   {far.neighbour[far_prev], old.neighbour[next], t},
                   {far.fixed[far_prev], old.fixed[next], false}};
  replace_neighbour(far.neighbour[far_next], o, t);
  replace_neighbour(old.neighbour[next], t, o);
  triangle_of_[a] = triangle_of_[u] = triangle_of_[d] = t;
  triangle_of_[v] = o;
}

void Triangulation::legalise(std::vector<Side>& queue) {
  while (!queue.empty()) {
    const Side side = queue.back();
    queue.pop_back();
    if (!violates_delaunay(side) || !is_flippable(side)) continue;
    const int other = triangles_[side.triangle].neighbour[side.edge];
    flip(side);
    for (int k = 0; k < 3; ++k) {
      queue.push_back({side.triangle, k});
      queue.push_back({other, k});
    }
  }
}

Triangulation::Side Triangulation::find_edge(int a, int b) const {
  // Walks around a, one way and, from the same start, the other way when a border stops it.
  const int start = triangle_of_[a];
  for (const bool forward : {true, false}) {
    int t = start;
    do {
      const auto& vertex = triangles_[t].vertex;
      const int k = vertex[0] == a ? 0 : vertex[1] == a ? 1 : 2;
      if (vertex[next_index(k)] == b) return {t, prev_index(k)};
      if (vertex[prev_index(k)] == b) return {t, next_index(k)};
      t = triangles_[t].neighbour[forward ? next_index(k) : prev_index(k)];
    } while (t >= 0 && t != start);
    if (t == start) break;
  }
  return {-1, -1};
}

bool Triangulation::crossed_edges(int a, int b, std::vector<std::array<int, 2>>& crossed) const {
  const GridPoint &p = points_[a], &q = points_[b];
  const int start = triangle_of_[a];
  Side side{-1, -1};
  for (const bool forward : {true, false}) {
    int t = start;
    do {
      const auto& vertex = triangles_[t].vertex;
      const int k = vertex[0] == a ? 0 : vertex[1] == a ? 1 : 2;
      const std::int64_t left = orientation(p, points_[vertex[next_index(k)]], q);
      const std::int64_t right = orientation(p, points_[vertex[prev_index(k)]], q);
      if (left > 0 && right < 0) side = {t, k};
      t = triangles_[t].neighbour[forward ? next_index(k) : prev_index(k)];
    } while (t >= 0 && t != start && side.triangle < 0);
    if (t == start || side.triangle >= 0) break;
  }
  if (side.triangle < 0) return false;  // the segment starts along an edge to a third vertex
  while (true) {
    const Triangle& t = triangles_[side.triangle];
    if (t.fixed[side.edge]) return false;
    crossed.push_back({t.vertex[next_index(side.edge)], t.vertex[prev_index(side.edge)]});
    const int other = t.neighbour[side.edge], m = mirrored_edge(side);
    const int tip = triangles_[other].vertex[m];
    if (tip == b) return true;
    const std::int64_t turn = orientation(p, q, points_[tip]);
    if (turn == 0) return false;
    side = {other, turn > 0 ? next_index(m) : prev_index(m)};
  }
}

bool Triangulation::insert_edge(int a, int b) {
  const auto fix = [&](Side side) {
    const int other = triangles_[side.triangle].neighbour[side.edge];
    if (other >= 0) triangles_[other].fixed[mirrored_edge(side)] = true;
    triangles_[side.triangle].fixed[side.edge] = true;
  };
  if (a == b) return false;
  if (const Side side = find_edge(a, b); side.triangle >= 0) {
    fix(side);
    return true;
  }
  std::vector<std::array<int, 2>> crossed;
  if (!crossed_edges(a, b, crossed)) return false;
  std::deque<std::array<int, 2>> pending(crossed.begin(), crossed.end());
  std::vector<std::array<int, 2>> made;
  while (!pending.empty()) {
    const auto [u, v] = pending.front();
    pending.pop_front();
    const Side side = find_edge(u, v);
    if (!is_flippable(side)) {
      pending.push_back({u, v});
      continue;
    }
    const int other = triangles_[side.triangle].neighbour[side.edge];
    const int apex = triangles_[side.triangle].vertex[side.edge];
    const int tip = triangles_[other].vertex[mirrored_edge(side)];
    flip(side);
    const auto sign = [&](int w) {
      const std::int64_t o = orientation(points_[a], points_[b], points_[w]);
      return (o > 0) - (o < 0);
    };
    const bool still_crosses =
        apex != a && apex != b && tip != a && tip != b && sign(apex) * sign(tip) < 0;
    if (still_crosses) {
      pending.push_back({apex, tip});
    } else {
      made.push_back({apex, tip});
    }
  }
  fix(find_edge(a, b));
  std::vector<Side> queue;
  for (const auto& [u, v] : made) {
    queue.clear();
    if (const Side side = find_edge(u, v); side.triangle >= 0) queue.push_back(side);
    legalise(queue);
  }
  return true;
}

}  // namespace quadrille
