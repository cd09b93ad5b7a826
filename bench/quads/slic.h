#pragma once

#include <optional>

#include "label_map.h"
#include "quadrille/raster.h"

namespace quadrille::bench {

struct SlicOptions {
  int size = 10;  ///< side of a cell on average, pixels
  /// Compactness m: what a distance of one cell size in space weighs against a distance in CIELAB
  /// (8-bit steps). The authors recommend 10 in a range of 1 to 40.
  float ruler = 10;
};

struct SlicResult {
  LabelMap labels;
  int cells = 0;
};

/// SLIC superpixels (Achanta et al. 2012) as OpenCV's documentation recommends: CIELAB after a
/// Gaussian of 3 x 3, ten rounds, small fragments absorbed. Nothing when the build found no
/// ximgproc module.
std::optional<SlicResult> slic(const Raster& picture, const SlicOptions& options);

}  // namespace quadrille::bench
