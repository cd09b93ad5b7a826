#include "svg_clip.h"

namespace quadrille {

SvgOutline clip_outline(const Layer& layer, const EdgeLoop& loop) {
  constexpr double kFlatness = 0.01;  // pixels
  SvgOutline outline;
  outline.is_exact = true;
  for (const int h : loop) {
    const PlaneCurve curve = edge_curve(layer, h);
    if (outline.pieces.empty()) outline.start = curve[0];
    const bool is_line = chord_distance(curve) <= kFlatness;
    outline.pieces.push_back({is_line, curve[1], curve[2], curve[3]});
  }
  return outline;
}

}  // namespace quadrille
