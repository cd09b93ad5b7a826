#pragma once

#include "bernstein_lanes.h"
#include "element_lanes.h"

namespace quadrille {

/// The unknowns value, dx, dy, twist of the four corners of kLaneCount patches, one channel.
using CornerLanes = Lanes[4][4];
/// Their Bezier form, 4 j + i, each times the binomial coefficients of its Bernstein polynomial.
using ControlLanes = Lanes[16];

/// The first control of a corner, and the steps to the next ones along u and v.
struct CornerPlace {
  int first, step_u, step_v;
  float sign_u, sign_v;  ///< thirds
};
inline constexpr float kThird = 1.0f / 3.0f;
inline constexpr CornerPlace kCornerPlaces[4] = {{0, 1, 4, kThird, kThird},
                                                 {3, -1, 4, -kThird, kThird},
                                                 {15, -1, -4, -kThird, -kThird},
                                                 {12, 1, -4, kThird, -kThird}};
/// Products of the binomial coefficients 1 3 3 1: of a corner, beside it, and diagonally.
inline constexpr float kBeside = 3, kDiagonal = 9;

/// Loads all unknowns of the corners of kLaneCount patches, channel by channel.
QUADRILLE_INLINE void gather_corners(const ElementGroup& group, const WedgeUnknowns* x,
                                     CornerLanes (&corners)[4]) {
  for (int k = 0; k < 4; ++k) {
    for (int unknown = 0; unknown < 4; ++unknown) {
      Lanes channel[4];
      load_channels([&](int p) { return x[group.wedges[k][p]].data() + 4 * unknown; }, channel);
#pragma GCC unroll 4
      for (int c = 0; c < 4; ++c) corners[c][k][unknown] = channel[c];
    }
  }
}

/// The way back: four channels of one unknown of one corner of kLaneCount patches.
QUADRILLE_INLINE void scatter(const Lanes (&channel)[4], int corner, int unknown,
                              CornerUnknowns* result) {
  Lanes row[4];
  transpose_blocks(channel, row);
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
    const auto low = __builtin_shufflevector(row[p], row[p], 0, 1, 2, 3);
    const auto high = __builtin_shufflevector(row[p], row[p], 4, 5, 6, 7);
    std::memcpy(result[p][corner].data() + 4 * unknown, &low, sizeof low);
    std::memcpy(result[p + 4][corner].data() + 4 * unknown, &high, sizeof high);
  }
}

/// Stores the unknowns of the first `channels` channels, zeros for the others.
QUADRILLE_INLINE void scatter_corners(const CornerLanes (&corners)[4], int channels,
                                      CornerUnknowns* result) {
  for (int k = 0; k < 4; ++k) {
    for (int unknown = 0; unknown < 4; ++unknown) {
      Lanes channel[4] = {};
      for (int c = 0; c < channels; ++c) channel[c] = corners[c][k][unknown];
      scatter(channel, k, unknown, result);
    }
  }
}

/// The numbers of a corner's map, see ElementGroup::set().
QUADRILLE_INLINE void load_map(const ElementGroup& group, int corner, Lanes (&m)[7]) {
#pragma GCC unroll 7
  for (int i = 0; i < 7; ++i) load(group.corners[corner][i], m[i]);
}

/// See colors_of().
QUADRILLE_INLINE void to_control(const ElementGroup& group, const CornerLanes& x,
                                 ControlLanes& control) {
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    constexpr auto& places = kCornerPlaces;
    Lanes m[7];
    load_map(group, k, m);
    const Lanes &value = x[k][0], &dx = x[k][1], &dy = x[k][2], &twist = x[k][3];
    const Lanes along_u = value + (dx * m[0] + dy * m[1]) * places[k].sign_u;
    const Lanes step_v = (dx * m[2] + dy * m[3]) * places[k].sign_v;
    const Lanes mixed =
        (dx * m[4] + dy * m[5] + twist * m[6]) * (places[k].sign_u * places[k].sign_v);
    const int at = places[k].first;
    control[at] = value;
    control[at + places[k].step_u] = along_u * kBeside;
    control[at + places[k].step_v] = (value + step_v) * kBeside;
    control[at + places[k].step_u + places[k].step_v] = (along_u + step_v + mixed) * kDiagonal;
  }
}

/// The transpose of to_control().
QUADRILLE_INLINE void from_control(const ElementGroup& group, const ControlLanes& control,
                                   CornerLanes& y) {
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    constexpr auto& places = kCornerPlaces;
    Lanes m[7];
    load_map(group, k, m);
    const int at = places[k].first;
    const Lanes along_u = control[at + places[k].step_u] * kBeside;
    const Lanes along_v = control[at + places[k].step_v] * kBeside;
    const Lanes inner = control[at + places[k].step_u + places[k].step_v] * kDiagonal;
    const Lanes du = (along_u + inner) * places[k].sign_u;
    const Lanes dv = (along_v + inner) * places[k].sign_v;
    const Lanes duv = inner * (places[k].sign_u * places[k].sign_v);
    y[k][0] = control[at] + along_u + along_v + inner;
    y[k][1] = du * m[0] + dv * m[2] + duv * m[4];
    y[k][2] = du * m[1] + dv * m[3] + duv * m[5];
    y[k][3] = duv * m[6];
  }
}

/// out = the moments of kLaneCount patches times in, see ElementGroup.
QUADRILLE_INLINE void multiply_moments(const float (&moments)[49][kLaneCount],
                                       const ControlLanes& in, ControlLanes& out) {
  for (int j = 0; j < 4; ++j) {
    Lanes sum[4] = {};
#pragma GCC unroll 4
    for (int l = 0; l < 4; ++l) {
      Lanes row[7];
#pragma GCC unroll 7
      for (int p = 0; p < 7; ++p) load(moments[7 * (j + l) + p], row[p]);
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
#pragma GCC unroll 4
        for (int k = 0; k < 4; ++k) sum[i] += row[i + k] * in[4 * l + k];
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) out[4 * j + i] = sum[i];
  }
}

}  // namespace quadrille
