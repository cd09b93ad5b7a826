#include "pdf_page.h"

#include "quadrille/error.h"
#include "svg_text.h"

namespace quadrille {

void check_page_options(const PdfOptions& options) {
  if (options.dpi >= 1 && options.dpi <= 10000 && options.tolerance >= 0.5) return;
  throw Error(ErrorCode::invalid_argument, "the PDF options dpi = " + to_text(options.dpi) +
                                               " and tolerance = " + to_text(options.tolerance) +
                                               " are not within 1 to 10000 and from 0.5 up; use 96"
                                               " and 2");
}

PageSize page_size(const VectorImage& image, const PdfOptions& options) {
  constexpr double kPointsPerInch = 72;
  const double scale = kPointsPerInch / options.dpi;
  return {image.width * scale, image.height * scale, scale};
}

std::string fixed(double number) { return to_short_text(number, 9); }

std::string shading_entries(const CoonsShading& shading, const CoordinateGrid& grid) {
  std::string decode = fixed(grid.origin.x()) + ' ' + fixed(grid.largest(0)) + ' ' +
                       fixed(grid.origin.y()) + ' ' + fixed(grid.largest(1));
  for (int c = 0; c < shading.channels; ++c) decode += " 0 1";
  return std::string("/ShadingType 6 /ColorSpace /Device") +
         (shading.channels == 1 ? "Gray" : "RGB") +
         " /BitsPerFlag 8 /BitsPerComponent 8 /BitsPerCoordinate " +
         to_text(static_cast<long long>(grid.bits)) + " /Decode [" + decode + ']';
}

std::string predictor(const CoonsShading& shading) {
  return "<< /Predictor 12 /Columns " + to_text(static_cast<long long>(shading.record_bytes)) +
         " >>";
}

std::string image_matrix(const Underlay& underlay) {
  const Eigen::Vector2d size = underlay.box.sizes(), corner = underlay.box.min();
  return fixed(size.x()) + " 0 0 -" + fixed(size.y()) + ' ' + fixed(corner.x()) + ' ' +
         fixed(corner.y() + size.y());
}

bool fills_page(const VectorImage& image, std::size_t index) {
  const Layer& layer = image.layers[index];
  return layer.transform.isApprox(Eigen::Affine2d::Identity(), 1e-12) &&
         validate(layer.patches.mesh, image.width, image.height).empty();
}

}  // namespace quadrille
