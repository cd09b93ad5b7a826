#include "element_lanes.h"

#include "corner_lanes.h"

namespace quadrille {

void ElementGroup::set(int lane, const std::array<CornerMap, 4>& maps, const double (&sums)[49],
                       const int* wedge_of_corner) {
  for (int i = 0; i < 49; ++i) moments[i][lane] = static_cast<float>(sums[i]);
  for (int k = 0; k < 4; ++k) {
    const CornerMap& m = maps[k];
    const float numbers[7] = {m.du.x(),  m.du.y(),  m.dv.x(), m.dv.y(),
                              m.duv.x(), m.duv.y(), m.twist};
    for (int i = 0; i < 7; ++i) corners[k][i][lane] = numbers[i];
    wedges[k][lane] = wedge_of_corner[k];
  }
}

QUADRILLE_MULTIVERSION
void multiply(const ElementGroup& group, int channels, const WedgeUnknowns* x,
              CornerUnknowns* result) {
  CornerLanes local[4];
  gather_corners(group, x, local);
  for (int c = 0; c < channels; ++c) {
    ControlLanes in, out;
    to_control(group, local[c], in);
    multiply_moments(group.moments, in, out);
    from_control(group, out, local[c]);
  }
  scatter_corners(local, channels, result);
}

QUADRILLE_MULTIVERSION
void diagonal_blocks(const ElementGroup& group, CornerUnknowns* result) {
  for (int k = 0; k < 4; ++k) {
    const CornerPlace& place = kCornerPlaces[k];
    const int at[4] = {place.first, place.first + place.step_u, place.first + place.step_v,
                       place.first + place.step_u + place.step_v};
    Lanes moment[4][4];
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        load(group.moments[7 * (at[a] / 4 + at[b] / 4) + at[a] % 4 + at[b] % 4], moment[a][b]);
      }
    }
    // The four unit vectors of the corner, one in each channel.
    Lanes column[4][4];
    for (int unit = 0; unit < 4; ++unit) {
      CornerLanes x = {};
      x[k][unit] += 1.0f;
      ControlLanes in, out = {};
      to_control(group, x, in);
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) out[at[a]] += moment[a][b] * in[at[b]];
      }
      from_control(group, out, x);
      for (int unknown = 0; unknown < 4; ++unknown) column[unknown][unit] = x[k][unknown];
    }
    for (int unknown = 0; unknown < 4; ++unknown) scatter(column[unknown], k, unknown, result);
  }
}

}  // namespace quadrille
