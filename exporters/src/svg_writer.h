#pragma once

#include <ostream>
#include <string>

#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"
#include "svg_detail.h"

namespace quadrille {

/// Writes the whole picture to the stream as SVG text, in chunks of patches, so that the memory it
/// takes stays small. Each layer is a group "layer-1", "layer-2", ..., and within it each smooth
/// region, which tears and the outline bound, a group "region-1", ... counted through the picture.
void write_svg_text(const VectorImage& image, const std::string& title, const SvgDetail& detail,
                    const RunContext& context, std::ostream& out);

}  // namespace quadrille
