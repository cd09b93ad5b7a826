#pragma once

#include <string>
#include <vector>

#include "quadrille/export.h"

namespace quadrille {

/// The picture as an uncompressed one-page PDF: every patch as sub-patches of a Type 7 shading
/// (tensor-product patch mesh), geometry exact, colours bilinear between the corners.
std::vector<unsigned char> draw_pdf(const VectorImage& image, const PdfOptions& options,
                                    const RunContext& context);

}  // namespace quadrille
