#pragma once

#include "quadrille/vectorize.h"

namespace quadrille {

/// How quadrangulate() meshes. A draft, for refine_by_error() to start from, may miss the wished
/// count by 10 % and is not snapped to features.
enum class MeshQuality { draft, final };

Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options,
                              MeshQuality quality, const RunContext& context);

}  // namespace quadrille
