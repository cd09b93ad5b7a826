#pragma once

#include <Eigen/Core>
#include <complex>

#include "quadrille/field_grid.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// Where the picture has features and which way they run, per working pixel.
struct FeatureTensor {
  /// Unit-modulus target e^{4 i theta} of the cross field, theta along the feature; 0 where the
  /// picture is flat.
  FieldGrid<std::complex<float>> direction;
  /// How much the direction matters: 0 in flat regions and where directions contradict each other
  /// to 1 on strong features.
  FieldGrid<float> weight;
  /// Colour gradient: points along the strongest change (either way), its length is that change in
  /// sRGB units per working pixel.
  FieldGrid<Eigen::Vector2f> gradient;
  /// 1 on the thinned feature lines (Canny), else 0.
  FieldGrid<unsigned char> edges;
};

struct FeatureOptions {
  double gradient_sigma = 1.0;  ///< of the Gaussian derivative, working pixels
  double tensor_sigma = 1.5;    ///< of the smoothing of the tensor, working pixels
};

/// Colour gradient (Di Zenzo) by Gaussian derivatives; the four-fold representation
/// |grad|^2 e^{4 i (phi + pi/2)} smoothed by a Gaussian; the weight is its modulus over a robust
/// scale, times its coherence (no exponential as in the paper's w = e^G, which overflows for 8-bit
/// gradients).
FeatureTensor feature_tensor(const Raster& working_picture, const FeatureOptions& options = {},
                             const RunContext& context = {});

}  // namespace quadrille
