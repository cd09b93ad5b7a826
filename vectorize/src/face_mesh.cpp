#include "face_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kStraight = 1e-9;  // sine of the bend below which a border counts as straight

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double corner_angle(const std::vector<Vector2d>& points, const Face& f, int k) {
  const Vector2d a = points[f.after(k)] - points[f[k]], b = points[f.before(k)] - points[f[k]];
  return std::atan2(cross(a, b), a.dot(b));
}

std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

int Face::corner_of(int v) const {
  for (int k = 0; k < size; ++k) {
    if (vertex[k] == v) return k;
  }
  return -1;
}

FaceMesh::FaceMesh(std::vector<Vector2d> positions, const std::vector<std::vector<int>>& faces)
    : points(std::move(positions)),
      guides(points.size()),
      faces_at_(points.size()),
      regular_(points.size(), 4),
      is_border_(points.size(), 0),
      is_corner_(points.size(), 0),
      has_kept_edge_(points.size(), 0) {
  for (const std::vector<int>& corners : faces) {
    Face face;
    face.size = static_cast<int>(corners.size());
    std::copy(corners.begin(), corners.end(), face.vertex.begin());
    add_face(face);
  }
  find_border();
}

void FaceMesh::find_border() {
  std::vector<int> after(points.size(), -1), before(points.size(), -1);
  for (int f = 0; f < face_slots(); ++f) {
    for (int k = 0; k < faces_[f].size; ++k) {
      if (across(f, k) >= 0) continue;
      after[faces_[f][k]] = faces_[f].after(k);
      before[faces_[f].after(k)] = faces_[f][k];
    }
  }
  for (int v = 0; v < vertex_count(); ++v) {
    if (after[v] < 0) continue;
    is_border_[v] = 1;
    double angle = 0;
    for (const int f : faces_at_[v]) {
      angle += corner_angle(points, faces_[f], faces_[f].corner_of(v));
    }
    regular_[v] = std::max(1, static_cast<int>(std::lround(angle / (std::numbers::pi / 2))));
    const Vector2d in = points[v] - points[before[v]], out = points[after[v]] - points[v];
    const bool is_straight =
        std::abs(cross(in, out)) <= kStraight * in.norm() * out.norm() && in.dot(out) > 0;
    is_corner_[v] = regular_[v] == 1;
    guides[v] = is_straight ? VertexGuide::on_line(points[v], (in + out).normalized())
                            : VertexGuide::at(points[v]);
  }
}

void FaceMesh::keep_edge(int a, int b) {
  kept_edges_.insert(sorted(a, b));
  for (const int v : {a, b}) {
    has_kept_edge_[v] = 1;
    guides[v] = VertexGuide::at(points[v]);
  }
}

bool FaceMesh::is_kept(int a, int b) const {
  return has_kept_edge_[a] && has_kept_edge_[b] && kept_edges_.count(sorted(a, b)) > 0;
}

int FaceMesh::face_with(int a, int b) const {
  for (const int f : faces_at_[a]) {
    if (faces_[f].after(faces_[f].corner_of(a)) == b) return f;
  }
  return -1;
}

void FaceMesh::collect_star(int v, std::vector<StarWedge>& wedges) const {
  wedges.clear();
  for (const int f : faces_at_[v]) {
    const Face& face = faces_[f];
    const int k = face.corner_of(v), n = face.size;
    wedges.push_back({points[face[(k + n - 2) % n]], points[face[(k + n - 1) % n]],
                      points[face[(k + 1) % n]], points[face[(k + 2) % n]]});
  }
}

int FaceMesh::irregularity_change(const FaceEdit& edit) const {
  int sum = 0;
  std::vector<int> lost, gained;
  const auto list = [&](const Face& face, int by, std::vector<int>& corners) {
    if (face.size == 3) sum += by;
    corners.insert(corners.end(), face.vertex.begin(), face.vertex.begin() + face.size);
  };
  for (const int f : edit.removed) list(faces_[f], -1, lost);
  for (const Face& face : edit.added) list(face, 1, gained);
  std::vector<int> touched = lost;
  touched.insert(touched.end(), gained.begin(), gained.end());
  remove_duplicates(touched);
  for (const int v : touched) {
    const int before = excess(v);
    const int after = before + static_cast<int>(std::count(gained.begin(), gained.end(), v) -
                                                std::count(lost.begin(), lost.end(), v));
    const bool vanishes = after + regular_[v] == 0;
    sum += (vanishes ? 0 : penalty(v, after)) - penalty(v, before);
  }
  return sum;
}

bool FaceMesh::complete_merges(FaceEdit& edit) const {
  edit.removed.clear();
  edit.added.clear();
  for (FaceEdit::Merge& m : edit.merged) {
    if (m.gone == m.kept || (has_kept_edge_[m.gone] && has_kept_edge_[m.kept])) return false;
    if (guides[m.gone].kind > guides[m.kept].kind) std::swap(m.gone, m.kept);
    const VertexGuide &gone = guides[m.gone], &kept = guides[m.kept];
    const bool is_free = gone.kind == VertexGuide::Kind::free;
    if (is_border(m.gone) && !is_border(m.kept)) return false;
    if (!is_free && is_border(m.kept) && !is_border(m.gone)) return false;
    // A vertex of a line may become the fixed end of it.
    const bool holds = kept.kind == VertexGuide::Kind::fixed
                           ? gone.kind == VertexGuide::Kind::line &&
                                 VertexGuide::on_line(kept.point, gone.direction).is_same_line(gone)
                           : gone.is_same_line(kept);
    if (!is_free && !holds) return false;
    for (const int v : {m.gone, m.kept}) {
      edit.removed.insert(edit.removed.end(), faces_at_[v].begin(), faces_at_[v].end());
    }
  }
  remove_duplicates(edit.removed);
  const auto image = [&](int v) {
    for (const FaceEdit::Merge& m : edit.merged) {
      if (v == m.gone) return m.kept;
    }
    return v;
  };
  for (const int f : edit.removed) {
    Face face;
    for (int k = 0; k < faces_[f].size; ++k) {
      const int v = image(faces_[f][k]);
      if (face.size == 0 || face[face.size - 1] != v) face.vertex[face.size++] = v;
    }
    if (face.size > 1 && face[0] == face[face.size - 1]) --face.size;
    const bool has_area =
        face.size == 3 || (face.size == 4 && face[0] != face[2] && face[1] != face[3]);
    if (has_area) edit.added.push_back(face);
  }
  return true;
}

int FaceMesh::add_face(const Face& face) {
  int f = face_slots();
  if (unused_.empty()) {
    faces_.push_back(face);
  } else {
    f = unused_.back();
    unused_.pop_back();
    faces_[f] = face;
  }
  for (int k = 0; k < face.size; ++k) faces_at_[face[k]].push_back(f);
  return f;
}

void FaceMesh::remove_face(int f) {
  for (int k = 0; k < faces_[f].size; ++k) {
    std::vector<int>& at = faces_at_[faces_[f][k]];
    at.erase(std::find(at.begin(), at.end(), f));
  }
  faces_[f].size = 0;
  unused_.push_back(f);
}

void FaceMesh::exchange(FaceEdit& edit) {
  FaceEdit inverse;
  for (const int f : edit.removed) {
    inverse.added.push_back(faces_[f]);
    remove_face(f);
  }
  for (const Face& face : edit.added) inverse.removed.push_back(add_face(face));
  inverse.merged = std::move(edit.merged);
  edit = std::move(inverse);
}

bool FaceMesh::apply(FaceEdit& edit) {
  exchange(edit);
  const auto is_whole = [&](const Face& face) {
    return std::all_of(face.vertex.begin(), face.vertex.begin() + face.size,
                       [&](int v) { return is_one_fan(v); });
  };
  const bool is_mesh = std::all_of(edit.added.begin(), edit.added.end(), is_whole) &&
                       std::all_of(edit.removed.begin(), edit.removed.end(),
                                   [&](int f) { return is_whole(faces_[f]); });
  if (!is_mesh) exchange(edit);
  return is_mesh;
}

bool FaceMesh::is_one_fan(int v) const {
  const std::vector<int>& fan = faces_at_[v];
  if (fan.empty()) return guides[v].kind != VertexGuide::Kind::fixed;
  if (!is_border(v) && fan.size() < 3) return false;
  const auto first_of = [&](int f) { return faces_[f].after(faces_[f].corner_of(v)); };
  const auto last_of = [&](int f) { return faces_[f].before(faces_[f].corner_of(v)); };
  // The face that starts where another ends; none or an ambiguous one gives -1.
  const auto following = [&](int f) {
    int found = -1;
    for (const int g : fan) {
      if (first_of(g) != last_of(f)) continue;
      if (found >= 0) return -1;
      found = g;
    }
    return found;
  };
  int start = fan.front();
  if (is_border(v)) {
    const auto follows_none = [&](int f) {
      return std::none_of(fan.begin(), fan.end(), [&](int g) { return last_of(g) == first_of(f); });
    };
    if (std::count_if(fan.begin(), fan.end(), follows_none) != 1) return false;
    start = *std::find_if(fan.begin(), fan.end(), follows_none);
  }
  int f = start;
  for (std::size_t i = 1; i < fan.size(); ++i) {
    f = following(f);
    if (f < 0 || f == start) return false;
  }
  return following(f) == (is_border(v) ? -1 : start);
}

VertexGuide FaceMesh::midpoint_guide(int a, int b, const Vector2d& midpoint) const {
  const bool is_held = face_with(a, b) < 0 || face_with(b, a) < 0 || is_kept(a, b) ||
                       guides[a].is_same_line(guides[b]);
  return is_held ? VertexGuide::on_line(midpoint, (points[b] - points[a]).normalized())
                 : VertexGuide::free();
}

QuadMesh FaceMesh::split(std::vector<VertexGuide>& split_guides) const {
  std::vector<HalvedEdge> kept;
  return split(split_guides, kept);
}

QuadMesh FaceMesh::split(std::vector<VertexGuide>& split_guides,
                         std::vector<HalvedEdge>& kept) const {
  std::vector<Vector2d> positions;
  split_guides.clear();
  kept.clear();
  const auto add = [&](const Vector2d& p, const VertexGuide& guide) {
    positions.push_back(p);
    split_guides.push_back(guide);
    return static_cast<int>(positions.size()) - 1;
  };
  std::vector<int> number(points.size(), -1);
  for (int v = 0; v < vertex_count(); ++v) {
    if (!faces_at_[v].empty()) number[v] = add(points[v], guides[v]);
  }
  std::vector<std::array<int, 4>> midpoints(faces_.size());
  std::vector<QuadMesh::Quad> quads;
  for (int f = 0; f < face_slots(); ++f) {
    const Face& face = faces_[f];
    if (face.size == 0) continue;
    Vector2d centre = Vector2d::Zero();
    for (int k = 0; k < face.size; ++k) {
      const int a = face[k], b = face.after(k), other = across(f, k);
      centre += points[a] / face.size;
      if (other >= 0 && other < f) {
        midpoints[f][k] = midpoints[other][faces_[other].corner_of(b)];
      } else {
        const Vector2d p = 0.5 * (points[a] + points[b]);
        midpoints[f][k] = add(p, midpoint_guide(a, b, p));
        if (is_kept(a, b)) {
          const auto [first, last] = sorted(a, b);
          kept.push_back({{first, last}, {number[first], midpoints[f][k], number[last]}});
        }
      }
    }
    const int c = add(centre, VertexGuide::free());
    for (int k = 0; k < face.size; ++k) {
      const int before = midpoints[f][(k + face.size - 1) % face.size];
      quads.push_back({number[face[k]], midpoints[f][k], c, before});
    }
  }
  return QuadMesh(std::move(positions), std::move(quads));
}

}  // namespace quadrille
