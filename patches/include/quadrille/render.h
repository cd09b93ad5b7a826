#pragma once

#include <array>
#include <optional>

#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// A rectangle of output pixels.
struct PixelRegion {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PixelRegion&) const = default;
};

struct RenderOptions {
  /// Output pixels per source pixel. The whole output measures output_size() pixels and shows the
  /// picture's rectangle exactly, so the effective factor per axis is output size / picture size.
  double scale = 1;
  /// When not 0, it decides the size instead of scale: the other side keeps the aspect ratio.
  int width = 0;
  int height = 0;
  /// The part of the output to draw; the whole when absent. Equal to the crop of the whole, bit for
  /// bit.
  std::optional<PixelRegion> region;
  /// Straight sRGB colour and alpha put behind the picture; transparent by default.
  std::array<float, 4> background = {0, 0, 0, 0};
};

/// Size in pixels of the whole output: max(1, round(side * scale)).
/// Throws Error{invalid_argument} for a scale or size that is not positive and finite, and
/// Error{limit_exceeded} above 2^30 pixels a side.
std::array<int, 2> output_size(const VectorImage& image, const RenderOptions& options);

/// Draws the picture; the reference that every exporter is judged by. RGB when the result is opaque
/// everywhere by construction (opaque image or background), RGBA otherwise; straight alpha; values
/// clamped to [0, 1]. Every sample belongs to exactly one patch of a layer; where patches overlap
/// because the mesh folds, to the one with the lowest index. In the smooth interior a pixel is a
/// point sample at its centre; in pixels that an outline or a tear crosses, every patch weighs as
/// many as it covers of 16 x 16 sub-samples, with its colour at their centroid. Below scale 1 all
/// pixels are box-filtered over k x k such samples, k the smallest power of two that is at least
/// 1 / scale. The same bytes for any thread count.
///
/// Time and memory are in proportion to the region, besides one quick test of every patch (some
/// 10 ns) and 300 bytes for it, so that outputs larger than memory can be drawn region by region.
/// Throws what output_size() throws; Error{invalid_argument} for a region that is not inside the
/// output, or a background, transform or mesh that is not finite; Error{limit_exceeded} for a
/// region above 2^32 pixels and for patches in it that reach 2^31 samples from the origin.
Raster render(const VectorImage& image, const RenderOptions& options = {},
              const RunContext& context = {});

/// How often each pixel centre of the whole output is covered by the patches of all layers; a valid
/// one-layer picture gives 1 everywhere. For tests and reports.
struct CoverageReport {
  long long uncovered = 0;       ///< pixels of the picture's rectangle that no patch covers
  long long doubly_covered = 0;  ///< pixels that two patches of one layer cover
};
CoverageReport count_coverage(const VectorImage& image, const RenderOptions& options = {},
                              const RunContext& context = {});

}  // namespace quadrille
