#pragma once

#include "premultiplied_colours.h"

namespace quadrille {

/// What the colours do across a line at one place.
struct EdgeProfile {
  double offset = 0;     ///< of the edge along the normal, pixels
  double contrast = 0;   ///< distance of the colours on both sides, sRGB units
  double sharpness = 0;  ///< share of the contrast within one pixel on either side, in [0, 1]
};

/// Measures the edge at `point` along the unit vector `normal`. The offset balances areas: it
/// divides the profile into two constant pieces with the same integral, which is right for any
/// symmetric blur but for the bilinear interpolation, a tenth of a pixel along oblique edges. The
/// sides lie 1 to 2.5 pixels off, no farther than the contrast keeps growing, so that both edges of
/// a thin line are found, also between two other colours.
EdgeProfile edge_profile(const PremultipliedColours& colours, const Eigen::Vector2d& point,
                         const Eigen::Vector2d& normal);

}  // namespace quadrille
