#pragma once

#include <vector>

#include "document_quantization.h"

namespace quadrille {

/// Finds the shapes and tangents of `moved`, whose vertices are those of `patches` rounded. Patches
/// that are certified free of folds stay so where straight edges allow it.
void quantize_tangents(const PatchMesh& patches, double position_step, QuantizedPatches& moved);

/// The tangents of `patches` from its shapes and vertices.
void set_tangents(double position_step, QuantizedPatches& patches);

}  // namespace quadrille
