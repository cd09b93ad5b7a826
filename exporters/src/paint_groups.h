#pragma once

#include <vector>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// In which order the patches of a layer are painted, such that their exact edges show at tears and
/// at the outline: the patches of group 0 first, then those of group 1 inside of its region, and so
/// on. On the two sides of a tear lie different groups wherever that can be; the patches of the
/// lower one may reach beyond the tear, and are then cut off exactly by the region of the higher.
struct PaintGroups {
  /// Patches that are not painted, and those that cannot be: as good as outside of the mesh.
  static constexpr int kUnpainted = -1, kUnpaintable = -2;

  std::vector<int> group;  ///< per quad, or one of these
  int count = 0;
  bool paints(int quad) const { return group[quad] >= 0 && group[quad] < count; }

  /// Whether something else cuts the picture off at the border of the mesh, and toward patches that
  /// are not painted; patches then reach beyond these edges.
  bool open_border = false, open_unpainted = false;
};

/// The groups of the painted quads; the edges toward all others are left closed. Of the others,
/// those without `paintable` cannot be painted; empty when all can.
PaintGroups paint_groups(const QuadMesh& mesh, const std::vector<char>& painted,
                         const std::vector<char>& paintable = {});

/// What is on the other side of a half-edge.
enum class Across {
  same,     ///< a patch of the same group, smoothly
  smooth,   ///< a patch of a lower group or none, smoothly
  open,     ///< what hides or cuts off whatever reaches there
  outside,  ///< nothing, or a patch of a lower group across a tear: the group's region ends here
  tangled,  ///< a patch of the same group across a tear: both end there without a region
};
Across across(const QuadMesh& mesh, const PaintGroups& groups, int h);

/// Half-edges one after another around quads.
using EdgeLoop = std::vector<int>;

/// The border of a set of quads; the set is on the positive side of the loops.
std::vector<EdgeLoop> border_of(const QuadMesh& mesh, const std::vector<char>& inside);

/// The border of the region of a group: of its patches and those around it over which it may reach,
/// so that its edges toward the `outside` cut it off; it never goes around patches that cannot be
/// painted. Patches of a lower group that the group meets across tears are left out, at a corner
/// alone too, even where that ends the region at a smooth edge, under which the lower ones go on.
/// Empty when there are no edges toward the outside.
std::vector<EdgeLoop> group_region(const QuadMesh& mesh, const PaintGroups& groups, int group);

}  // namespace quadrille
