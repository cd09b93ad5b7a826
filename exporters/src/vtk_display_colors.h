#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vtk_points.h"

namespace quadrille {

/// Straight 8-bit red, green, blue, alpha per control point, for programs that draw bytes as they
/// are. Clamping control values would be wrong where they overshoot, as they do beside every sharp
/// contrast although the patch itself stays in range: cut there, a colour ramp loses its slope. So
/// these are the bytes whose patch comes nearest, by least squares, to the picture that is shown:
/// the rounded control values where those lie in range, a compromise where they do not. Points that
/// neighbours share depend on nothing but the shared edge.
std::vector<std::array<std::uint8_t, 4>> display_colors(const ControlPoints& points);

}  // namespace quadrille
