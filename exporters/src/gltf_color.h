#pragma once

#include <algorithm>
#include <cmath>

#include "quadrille/patch_mesh.h"

namespace quadrille {

inline Color clamped(const Color& color) { return color.cwiseMax(0.0f).cwiseMin(1.0f); }

/// IEC 61966-2-1.
inline float linear_light(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

/// Colour divided by alpha, sRGB-encoded, in [0, 1]; black where it is transparent.
inline Color straight_color(const Color& premultiplied) {
  Color color = clamped(premultiplied);
  const float alpha = color[3];
  if (alpha > 0) color.head<3>() = (color.head<3>() / alpha).cwiseMin(1.0f);
  return color;
}

/// Luma of Rec. 709, 0 to 1; what is transparent is dark.
inline double luma(const Color& premultiplied) {
  const Color c = clamped(premultiplied);
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

}  // namespace quadrille
