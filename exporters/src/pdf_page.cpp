#include "pdf_page.h"

#include <cmath>

#include "quadrille/error.h"
#include "svg_text.h"

namespace quadrille {

void check_page_options(const PdfOptions& options) {
  const auto good = [](double number) { return number > 0 && std::isfinite(number); };
  if (good(options.dpi) && good(options.tolerance)) return;
  throw Error(ErrorCode::invalid_argument, "the PDF options dpi = " + to_text(options.dpi) +
                                               " and tolerance = " + to_text(options.tolerance) +
                                               " must be positive numbers; use 96 and 4");
}

PageSize page_size(const VectorImage& image, const PdfOptions& options) {
  constexpr double kPointsPerInch = 72;
  const double scale = kPointsPerInch / options.dpi;
  return {image.width * scale, image.height * scale, scale};
}

std::string fixed(double number) { return to_short_text(number, 9); }

bool fills_page(const VectorImage& image, std::size_t index) {
  const Layer& layer = image.layers[index];
  return layer.transform.isApprox(Eigen::Affine2d::Identity(), 1e-12) &&
         validate(layer.patches.mesh, image.width, image.height).empty();
}

}  // namespace quadrille
