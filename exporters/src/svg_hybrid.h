#pragma once

#include <ostream>
#include <string>

#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// Writes the picture as embedded pixels behind exact outlines: per sheet of a layer (see
/// SheetedLayer) an image that goes on beyond its patches, clipped along tears and the outline.
/// Transparency is a mask of such images in grays. Contours are sharp at any scale; what lies
/// between them has the images' resolution.
void write_hybrid_svg(std::ostream& out, const VectorImage& image, const std::string& title,
                      const RunContext& context);

}  // namespace quadrille
