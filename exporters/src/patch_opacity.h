#pragma once

#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

enum class PatchOpacity : unsigned char { transparent, translucent, opaque };

/// Per patch; an alpha within `tolerance` (of 1) of 0 or 1 counts as such.
std::vector<PatchOpacity> patch_opacities(const PatchMesh& patches, double tolerance);

/// The same, but patches that are not `paintable` count as transparent.
std::vector<PatchOpacity> paint_opacities(const PatchMesh& patches, double tolerance,
                                          const std::vector<char>& paintable);

/// The patches of this opacity in ascending order.
std::vector<int> patches_with(const std::vector<PatchOpacity>& opacities, PatchOpacity wanted);

}  // namespace quadrille
