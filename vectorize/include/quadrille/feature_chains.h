#pragma once

#include <Eigen/Core>
#include <vector>

#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

struct ChainOptions {
  /// Least mean contrast of a chain: distance of the colours on both sides, premultiplied sRGB and
  /// alpha in [0, 1]. Positive.
  double contrast = 0.1;
  /// Least contrast anywhere along a chain (hysteresis). Positive.
  double weak_contrast = 0.05;
  /// Least mean sharpness: the share of the contrast that lies within one pixel on either side; an
  /// unblurred edge has 1, a smooth ramp 0.4. In [0, 1].
  double sharpness = 0.86;
  /// Chains shorter than this, in pixels, are left out where one of their ends is free. In
  /// [0, 1e9].
  double min_length = 6;
};

/// A line along which colours jump.
struct FeatureChain {
  std::vector<Eigen::Vector2d> points;  ///< about a pixel apart, source pixels, first to last node
  int from = -1, to = -1;               ///< nodes; the same for a closed chain
  double length = 0;                    ///< pixels
  double contrast = 0;                  ///< mean along it
  double sharpness = 0;                 ///< mean along it
  double gain = 0;                      ///< what following it is worth, any unit; contrast at first
};

/// Chains and the nodes where they end: junctions, corners (turns by more than about 45 degrees),
/// free ends, and places on the border of the picture.
struct ChainNetwork {
  std::vector<Eigen::Vector2d> nodes;
  std::vector<FeatureChain> chains;
};

/// The sharp colour edges of a picture to a fraction of a pixel: ridges of the gradient, which part
/// its watershed's basins, so that they are closed and meet at junctions; kept where their contrast
/// and sharpness are sufficient, and moved to where the profile across them is balanced. Throws
/// Error{invalid_argument} for options outside their ranges.
ChainNetwork feature_chains(const Raster& picture, const ChainOptions& options = {},
                            const RunContext& context = {});

/// Leaves out the chains with the least gain until, with a vertex at every `spacing` along them
/// and one at each end, there are at most `vertices`.
void shed_weak_chains(ChainNetwork& network, double spacing, double vertices);

}  // namespace quadrille
