#pragma once

#include <Eigen/Core>
#include <array>
#include <set>
#include <span>
#include <vector>

#include "quadrille/quad_mesh.h"
#include "vertex_star.h"

namespace quadrille {

/// A face with 3 or 4 corners, positively oriented; 0 corners: an unused slot.
struct Face {
  std::array<int, 4> vertex{};
  int size = 0;

  int operator[](int k) const { return vertex[k]; }
  int after(int k) const { return vertex[k + 1 == size ? 0 : k + 1]; }
  int before(int k) const { return vertex[k == 0 ? size - 1 : k - 1]; }
  /// The corner at v, -1 if v is none.
  int corner_of(int v) const;
};

/// A change of connectivity: faces that go, faces that come instead, and the vertices that become
/// another one by it.
struct FaceEdit {
  struct Merge {
    int gone, kept;
  };
  std::vector<int> removed;
  std::vector<Face> added;
  std::vector<Merge> merged;
};

/// A kept edge after the division of the faces.
struct HalvedEdge {
  std::array<int, 2> ends;  ///< points of the face mesh, the lower one first
  std::array<int, 3> path;  ///< vertices of the quads: first end, midpoint, last end
};

/// A planar mesh of triangles and quads whose connectivity can be edited. Each face is to be
/// divided once (see split()): a vertex is regular where four faces meet (on the border: as many as
/// its angle has right angles), and a face is regular when it is a quad.
class FaceMesh {
 public:
  /// The faces are lists of 3 or 4 corners as convex_faces() returns them. Border vertices slide
  /// where the border is straight and are fixed elsewhere; inner vertices are free.
  FaceMesh(std::vector<Eigen::Vector2d> points, const std::vector<std::vector<int>>& faces);

  std::vector<Eigen::Vector2d> points;  ///< those without faces are unused
  std::vector<VertexGuide> guides;      ///< one per point

  /// No edit removes this edge. Its ends stay where they are and apart from other kept edges'.
  void keep_edge(int a, int b);

  int vertex_count() const { return static_cast<int>(points.size()); }
  int face_slots() const { return static_cast<int>(faces_.size()); }
  const Face& face(int f) const { return faces_[f]; }
  const std::vector<int>& faces_at(int v) const { return faces_at_[v]; }
  bool is_border(int v) const { return is_border_[v]; }
  bool is_kept(int a, int b) const;
  /// Faces at v beyond the regular number.
  int excess(int v) const { return static_cast<int>(faces_at_[v].size()) - regular_[v]; }
  /// What v adds to the irregularity with this excess: its square, four times that at the corners
  /// of the border, where no shape makes up for it.
  int penalty(int v, int excess) const { return excess * excess * (is_corner_[v] ? 4 : 1); }
  /// The face with the directed edge from a to b; -1 outside.
  int face_with(int a, int b) const;
  /// The face across the edge from corner k of f to the next; -1 outside.
  int across(int f, int k) const { return face_with(faces_[f].after(k), faces_[f][k]); }
  /// The faces around v as its star in which it can be moved.
  void collect_star(int v, std::vector<StarWedge>& wedges) const;

  /// By how much an edit would change the irregularity: the sum of the vertices' penalties, plus
  /// one for every triangle.
  int irregularity_change(const FaceEdit& edit) const;
  /// Fills in the faces that the merges of an edit remove and add. The vertex with the stricter
  /// guide is kept. False when the two may not become one: both fixed, on different lines, both
  /// ends of kept edges, or one on the border and the other held elsewhere.
  bool complete_merges(FaceEdit& edit) const;
  /// Carries out an edit, which becomes its own inverse. False, and nothing changed, when the
  /// result would not be a mesh in which inner vertices have three faces or more.
  bool apply(FaceEdit& edit);

  /// Catmull-Clark connectivity: every n-gon becomes n quads around its centre, joined at the
  /// midpoints of its edges. If faces are strictly convex, so are the quads. Midpoints of border
  /// and kept edges slide along them, those between two vertices on one line along that.
  QuadMesh split(std::vector<VertexGuide>& split_guides) const;
  QuadMesh split(std::vector<VertexGuide>& split_guides, std::vector<HalvedEdge>& kept) const;

 private:
  std::vector<Face> faces_;
  std::vector<int> unused_;  // slots
  std::vector<std::vector<int>> faces_at_;
  std::vector<int> regular_;  // wished number of faces at each vertex
  std::vector<char> is_border_, is_corner_;
  std::set<std::array<int, 2>> kept_edges_;
  std::vector<char> has_kept_edge_;

  void find_border();
  int add_face(const Face& face);
  void remove_face(int f);
  void exchange(FaceEdit& edit);
  bool is_one_fan(int v) const;
  VertexGuide midpoint_guide(int a, int b, const Eigen::Vector2d& midpoint) const;
};

}  // namespace quadrille
