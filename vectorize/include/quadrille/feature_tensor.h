#pragma once

#include <Eigen/Core>
#include <complex>

#include "quadrille/field_grid.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// A working pixel that the border of the meshed region runs through.
struct OutlinePixel {
  int x = 0, y = 0;
  Eigen::Vector2f point = Eigen::Vector2f::Zero();   ///< of the border, working pixels
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< across the border, unit length

  /// The cross aligned with the border, e^{4 i theta}.
  std::complex<float> cross() const {
    const std::complex<float> n(normal.x(), normal.y());
    return n * n * n * n;
  }
};

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
  /// Where the border of the meshed region lies inside the picture, at most once per pixel and
  /// without its corners: the cross field is aligned with it and the lattice lies on it, as along
  /// the picture's sides. Empty when the whole picture is meshed.
  std::vector<OutlinePixel> outline;
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
