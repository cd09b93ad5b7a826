#pragma once

#include <limits>

#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

enum class FitMethod {
  bessel,  ///< the paper, section 4.1: colour sampled at the vertex, Bessel derivatives, no twist
  bessel_ls,  ///< one colour per wedge by least squares over all pixels, Bessel derivatives, no
              ///< twist
  hermite,    ///< value, gradient and twist per wedge by least squares over all pixels
};

struct FitOptions {
  FitMethod method = FitMethod::hermite;
  /// Tikhonov weight toward the Bessel solution, as a share of what the pixels weigh: every square
  /// pixel of a patch adds this weight times the mean squared distance of its colours from that
  /// solution; more where tears leave the colours of pixels' parts open. Positive.
  double regularization = 1e-4;
  /// Length in pixels, not negative, at whose fourth power the squared second derivatives of the
  /// colours count beside the squared error. It says what the colours do between the pixels of
  /// patches that have few of them, which shows when the picture is enlarged: enough that they do
  /// not ring, little enough that they still pass through the pixels.
  double smoothness = 0.2;
  /// How far a premultiplied channel or alpha should leave at most the range that it has in the
  /// pixels of a patch's bounding box and one pixel around it, on the sRGB scale of 1; not
  /// negative, infinite for no bound. Where the fit goes farther, at 5 x 5 places of a patch, it is
  /// made again with an equation of a pixel's weight against each, twice, which leaves a fraction
  /// of the excess. Drawings look better enlarged; in photographs highlights between the pixels are
  /// as likely as not. Bessel colours (FitMethod::bessel) are not bound.
  double max_overshoot = std::numeric_limits<double>::infinity();
  /// The conjugate gradients start at the Bessel solution and stop when its residual has fallen by
  /// this factor; in (0, 1).
  double tolerance = 1e-4;
  int max_iterations = 200;  ///< of the conjugate gradients, positive
};

/// Throws Error{invalid_argument} for options outside their ranges, as what takes them does.
void check_options(const FitOptions& options);

/// The same options with a tolerance of at least 1e-2 and without a bound on overshoot, for fits
/// that are only compared with each other or made again.
FitOptions draft_options(FitOptions options);

struct FitReport {
  int iterations = 0;   ///< of the conjugate gradients in all fits; 0 for bessel
  double residual = 0;  ///< relative, at the end of the last fit
};

/// Estimates the colours of every wedge so that the patches reproduce the picture: hermite and
/// bessel_ls minimise the squared difference at the pixel centres and the options' other terms,
/// alpha premultiplied, clamping left to the renderer. Where a tear, or the border of the mesh
/// inside the picture, crosses a pixel, the mixture of patches that render() draws there is
/// compared instead, beyond the border as if the picture's colours were seen through the mesh.
/// Geometry is taken as it is. The picture's rectangle must contain the mesh; pixel (i, j) has its
/// centre at (i + 0.5, j + 0.5). A picture without alpha gives opaque patches: alpha exactly 1, its
/// derivatives exactly 0. Linear pictures are reproduced by all methods. The same bits for any
/// thread count. Throws Error{invalid_argument} for a mesh without patches, an empty picture or
/// options outside their ranges.
FitReport fit_colors(PatchMesh& patches, const Raster& picture, const FitOptions& options = {},
                     const RunContext& context = {});

/// Geometry and colours in one step: straight_patches, set_bessel_tangents, guard_folds,
/// fit_colors. The mesh must have strictly convex quads (see validate()).
PatchMesh fit_patches(QuadMesh mesh, const Raster& picture, const FitOptions& options = {},
                      const RunContext& context = {});

}  // namespace quadrille
