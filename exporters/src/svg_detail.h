#pragma once

namespace quadrille {

/// How finely an SVG file approximates the picture.
struct SvgDetail {
  /// What a byte of the compressed file may cost in squared error: square pixels times squared
  /// 8-bit steps, mean of the channels.
  double price = 1;
  int units_per_pixel = 8;  ///< coordinates are multiples of 1 / units_per_pixel pixel
};

/// What cells show: the colour itself, or alpha as gray for a mask.
enum class CellPaint { color, alpha };

}  // namespace quadrille
