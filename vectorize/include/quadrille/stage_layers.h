#pragma once

#include <vector>

#include "quadrille/scene_layer.h"
#include "quadrille/vectorize.h"

namespace quadrille {

/// A stage of quadrangulate() as layers of a scene.
struct SceneStage {
  const char* name;
  const char* summary;
  bool needs_fields;  ///< there is nothing to show when a lattice was used without any fields
  /// `drawing_pixel` is the size of a pixel of the drawing in source pixels, > 0: crosses and other
  /// glyphs are subsampled and sized so that they can be told apart.
  std::vector<SceneLayer> (*layers)(const Quadrangulation& stages, double drawing_pixel);
};

/// All of them, in the order of the computation:
///  - "feature": "feature-strength", a grid of the working pixels with "weight", "edge", "gradient"
///    and the unit vector "direction";
///  - "cross-field": "cross-field", crosses with the unit vectors "axis_u" and "axis_v" and
///    "weight"; "cancelled-singularities"; "singularities" with "quarter_index";
///  - "scale": "edge-length", a grid with "length_u", "length_v" and "length"; "edge-crosses",
///    crosses whose vectors have these lengths;
///  - "position": "lattice-points" with the vector "offset" to their working pixels;
///    "singularities";
///  - "quads": "quads", "feature-chains" with "contrast", "sharpness", "length" and "gain" where
///    there are any, "irregular-vertices";
///  - "patches": "patch-edges", "irregular-vertices".
const std::vector<SceneStage>& scene_stages();

/// False where a stage needs fields and a lattice was used without any.
bool can_show(const SceneStage& stage, const Quadrangulation& stages);

}  // namespace quadrille
