#pragma once

#include <memory>

#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "quadrille/scene_layer.h"
#include "quadrille/vectorize.h"

namespace quadrille::cli {

/// What a vector image was made from, as far as it is at hand.
struct Origin {
  const Raster* picture = nullptr;          ///< as large as the image
  const Quadrangulation* stages = nullptr;  ///< without fields for a lattice
};

/// Enlarges small pictures until mesh lines and crosses can be told apart: drawing pixels per
/// source pixel.
double readable_scale(double width, double height);

/// All that is known: the group "picture" and one for each stage, named like it.
Scene scene_of(const VectorImage& image, const Origin& origin, const RunContext& context);

}  // namespace quadrille::cli
