#pragma once

#include "lanes.h"

namespace quadrille {

/// A patch's geometry in power basis as plain floats: 4 j + i weighs u^i v^j.
struct GeometryCoefficients {
  float map[2][3];  ///< given points to normalized ones: x = map[0][0] x + map[0][1] y + map[0][2]
  float start[2][6];  ///< see NormalizedPatch
  float position[2][16];
};

struct PatchCoefficients {
  GeometryCoefficients geometry;
  float color[4][16];
};

/// Points in, parameters out; arrays have `count` elements, a multiple of kLaneCount.
struct PointBatch {
  int count;
  const float *x, *y;
  float *u, *v;
  int* found;  ///< not 0 where the point's parameters were found in or next to the patch
};

/// Points in, premultiplied colours out; arrays have `count` elements, a multiple of kLaneCount.
struct LaneBatch {
  int count;
  const float *x, *y;
  float* color[4];
  int* found;  ///< not 0 where the point's parameters were found in or next to the patch
};

/// Inverts the geometry by Newton's method and evaluates the colour, kLaneCount points at a time. A
/// lane stops moving when it has converged, so no point's result depends on another's; all
/// instruction sets give the same bits. Colours are clamped to 0 <= r, g, b <= alpha <= 1; with
/// `opaque` alpha is 1.
void shade_lanes(const PatchCoefficients& c, bool opaque, const LaneBatch& batch);

/// The inversion alone; the same arithmetic.
void invert_lanes(const GeometryCoefficients& c, const PointBatch& batch);

/// The colour at given parameters, the same arithmetic for a single point.
void shade_at(const PatchCoefficients& c, bool opaque, float u, float v, float (&color)[4]);

}  // namespace quadrille
