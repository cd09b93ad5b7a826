#pragma once

#include <vector>

#include "document_quantization.h"

namespace quadrille {

/// Finds the shapes and tangents of `moved`, whose vertices are those of `patches` rounded. Patches
/// that are certified free of folds stay so where straight edges allow it. Returns how many do not.
int quantize_tangents(const PatchMesh& patches, double position_step, QuantizedPatches& moved);

/// Whether all tangents are the same but for the rounding of doubles.
bool are_same_tangents(const std::vector<EdgeTangents>& a, const std::vector<EdgeTangents>& b,
                       double position_step);

/// The tangents of `patches` from its shapes and vertices.
void set_tangents(double position_step, QuantizedPatches& patches);

}  // namespace quadrille
