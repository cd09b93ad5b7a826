#include "svg_clip.h"

#include <cmath>

namespace quadrille {

bool is_on_a_side(const PlaneCurve& curve, double width, double height) {
  constexpr double kSamePlace = 1e-3;  // pixels
  const double sides[2][2] = {{0, width}, {0, height}};
  for (int axis = 0; axis < 2; ++axis) {
    for (const double side : sides[axis]) {
      if (std::abs(curve[0][axis] - side) < kSamePlace &&
          std::abs(curve[3][axis] - side) < kSamePlace) {
        return true;
      }
    }
  }
  return false;
}

bool fills_picture(const Layer& layer, double width, double height) {
  const QuadMesh& mesh = layer.patches.mesh;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < 0 && !is_on_a_side(edge_curve(layer, h), width, height)) return false;
  }
  return true;
}

SvgOutline clip_outline(const Layer& layer, const EdgeLoop& loop) {
  constexpr double kFlatness = 0.01;  // pixels
  SvgOutline outline;
  for (const int h : loop) {
    const PlaneCurve curve = edge_curve(layer, h);
    if (outline.pieces.empty()) outline.start = curve[0];
    const bool is_line = chord_distance(curve) <= kFlatness;
    outline.pieces.push_back({is_line, curve[1], curve[2], curve[3], true});
  }
  return outline;
}

}  // namespace quadrille
