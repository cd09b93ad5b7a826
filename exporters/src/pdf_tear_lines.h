#pragma once

#include <vector>

#include "paint_groups.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Tears along which the colours of the side with more alpha should go on to the far end of the
/// pixels that both sides share: half-edges of a group, by whether the group's region grows there
/// or shrinks.
///
/// Of a pixel, let one side cover the part f with alpha a, the other the rest with alpha b. One
/// mask for both gives it the alpha fa + (1 - f)b, rightly, but mixes their colours by f alone.
/// That is wrong by f(1 - f)(a - b) times the difference of the colours, at most (a - b) / 4. With
/// the one side's colour alone, it is wrong by (1 - f)b, b / 2 in the middle: less when a > 3b.
struct TearLines {
  std::vector<int> growing, shrinking;
};
TearLines tear_lines(const PatchMesh& patches, const PaintGroups& groups, int group);

}  // namespace quadrille
