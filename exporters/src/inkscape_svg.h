#pragma once

#include <ostream>
#include <string>

#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// Writes the picture as an SVG document of mesh gradients, as Inkscape draws and edits them: one
/// <meshgradient> for each of regular_grids(), which fills a path with the grid's outline. Other
/// programs show the mean colour of each. Grids go on under opaque ones painted after them. Throws
/// Error{cancelled}.
void write_inkscape_svg(std::ostream& out, const VectorImage& image, const std::string& title,
                        const RunContext& context);

}  // namespace quadrille
