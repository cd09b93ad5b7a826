#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "quadrille/bicubic.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// sRGB-encoded red, green, blue, each premultiplied by alpha, and alpha. Fitted values may leave
/// [0, 1] slightly; whoever draws clamps.
using Color = Eigen::Array4f;

/// The colour at a vertex as seen by the corners between two tear edges. The derivatives of a patch
/// along u and v follow from the gradient and the patch's tangents, so that linear colours are
/// reproduced exactly at any valence.
struct Wedge {
  Color value = Color::Zero();
  Color dx = Color::Zero();     ///< d colour / dx, per pixel
  Color dy = Color::Zero();     ///< d colour / dy, per pixel
  Color twist = Color::Zero();  ///< per square pixel; see ferguson_patch()
};

/// One bicubic Ferguson patch: geometry in pixels, colour premultiplied.
struct FergusonPatch {
  BicubicHermite<Eigen::Vector2d> position;
  BicubicHermite<Color> color;
};

struct BezierPatch {
  BicubicBezier<Eigen::Vector2d> position;
  BicubicBezier<Color> color;
};

/// A mesh of Ferguson patches: geometry is shared along edges (watertight), colour is shared within
/// wedges. Without tears a vertex has one wedge.
struct PatchMesh {
  QuadMesh mesh;

  /// Per edge the curve's derivative with respect to its parameter t in [0, 1], at the origin and
  /// at the tip of mesh.halfedge(e), both pointing along that half-edge; in pixels.
  std::vector<std::array<Eigen::Vector2d, 2>> edge_tangents;

  std::vector<int> wedge_of_corner;  ///< #H: corner k of quad q is 4 q + k
  std::vector<Wedge> wedges;         ///< #W

  /// True when alpha is 1 everywhere; consumers then leave transparency out.
  bool opaque = true;

  int patch_count() const { return mesh.quad_count(); }
};

/// Where a PatchMesh from elsewhere contradicts itself, as a phrase such as "the wedges contradict
/// the tears": sizes of its arrays, wedges out of range or unused, wedges that do not divide the
/// corners of each vertex as its tears do, numbers that are not finite. Empty when it does not.
std::string contradiction_in(const PatchMesh& patches);

/// A PatchMesh over the mesh with straight edges (tangents equal to the chords) and black, opaque
/// wedges numbered by vertex and then by fan order; a vertex is divided at its tear edges.
/// A single tear edge that ends inside the picture does not divide the vertex at its end.
PatchMesh straight_patches(QuadMesh mesh);

/// Derivative of the edge curve along half-edge h at its origin (at = 0) or tip (at = 1).
Eigen::Vector2d tangent_along(const PatchMesh& patches, int h, int at);

/// Geometry of patch q. Twists are Adini's: at corner (0,0)
/// P_uv = [P_u(0,1) - P_u(0,0)] + [P_v(1,0) - P_v(0,0)] - [P_11 - P_10 - P_01 + P_00], and likewise
/// at the others, so that straight-edged patches are bilinear.
BicubicHermite<Eigen::Vector2d> patch_geometry(const PatchMesh& patches, int q);

/// +1 or -1: how a wedge's twist enters corner h. It alternates around a vertex, which makes
/// neighbouring patches of a regular lattice share their mixed derivative.
inline int twist_sign(const QuadMesh& mesh, int h) {
  return ((QuadMesh::corner_of(h) + mesh.fan_position(h)) & 1) ? -1 : 1;
}

/// Patch q whole. Colour derivatives at a corner with tangents P_u, P_v and twist P_uv are
/// c_u = dx P_u.x + dy P_u.y, c_v likewise, and
/// c_uv = dx P_uv.x + dy P_uv.y + twist_sign * twist * |P_u| |P_v|.
FergusonPatch ferguson_patch(const PatchMesh& patches, int q);

/// The same patch in Bezier form.
BezierPatch bezier_patch(const PatchMesh& patches, int q);

}  // namespace quadrille
