#pragma once

#include "quadrille/raster.h"

namespace quadrille {

/// What kind of picture it is, in figures. Pixels count as 8-bit sRGB; those with alpha 0 have no
/// colour and belong to transparent_share only.
struct Content {
  int width = 0, height = 0;
  /// Share of the pixels that equal their right and their lower neighbour exactly: up to 0.25 in
  /// photographs, whose noise leaves no two pixels alike, and from 0.5 up in flat graphics, even
  /// when they come from a JPEG of medium quality.
  double flat_share = 0;
  /// The smallest number of colours, at 5 bits a channel, that make up 90 % of the pixels: below 20
  /// in flat graphics (80 after JPEG), mostly hundreds in photographs.
  int main_colors = 0;
  double transparent_share = 0;  ///< of all pixels, alpha 0
};

/// Throws Error{invalid_argument} for a malformed picture.
Content classify_content(const Raster& picture);

}  // namespace quadrille
