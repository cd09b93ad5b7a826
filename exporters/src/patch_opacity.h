#pragma once

#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

enum class PatchOpacity : unsigned char { transparent, translucent, opaque };

/// Per patch; an alpha within `tolerance` (of 1) of 0 or 1 counts as such.
std::vector<PatchOpacity> patch_opacities(const PatchMesh& patches, double tolerance);

/// The patches of this opacity in ascending order.
std::vector<int> patches_with(const std::vector<PatchOpacity>& opacities, PatchOpacity wanted);

}  // namespace quadrille
