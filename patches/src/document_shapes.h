#pragma once

#include <vector>

#include "document_quantization.h"

namespace quadrille {

/// The shapes of the edges of `patches` for the moved vertices of `mesh`. Patches that are
/// certified free of folds stay so where straight edges allow it.
std::vector<EdgeShape> quantize_tangents(const PatchMesh& patches, const QuadMesh& mesh,
                                         double position_step);

}  // namespace quadrille
