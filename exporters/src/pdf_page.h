#pragma once

#include <cstddef>
#include <string>

#include "pdf_shading.h"
#include "pdf_underlay.h"
#include "quadrille/export.h"

namespace quadrille {

/// What PDF and PostScript have in common.

/// Throws Error{invalid_argument} for options outside their ranges.
void check_page_options(const PdfOptions& options);

struct PageSize {
  double width, height;  ///< points
  double scale;          ///< points per pixel of the picture
};
PageSize page_size(const VectorImage& image, const PdfOptions& options);

/// The number without an exponent, which PDF does not know.
std::string fixed(double number);

/// The entries of a shading dictionary, without its data.
std::string shading_entries(const CoonsShading& shading, const CoordinateGrid& grid);
/// The parameters of the filter that inflates its data.
std::string predictor(const CoonsShading& shading);

/// The matrix that takes the unit square with y up to where the underlay lies, y down.
std::string image_matrix(const Underlay& underlay);

/// True when layer `index` covers the whole page, so that the page itself cuts it off.
bool fills_page(const VectorImage& image, std::size_t index);

}  // namespace quadrille
