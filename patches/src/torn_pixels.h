#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A pixel that a tear crosses, with the colour that it is drawn with: each patch's colour, clamped
/// and premultiplied, by the share of the pixel that the patch covers.
struct TornPixel {
  std::uint32_t pixel;  ///< y * width + x
  Color color;
};

/// All of them in a picture of width x height pixels, but for those that the mesh does not cover
/// entirely. Runs in the caller's tbb arena; the order does not depend on it.
std::vector<TornPixel> torn_pixels(const PatchMesh& patches, int width, int height);

}  // namespace quadrille
