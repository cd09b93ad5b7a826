#pragma once

#include <Eigen/Geometry>
#include <array>

namespace quadrille {

/// The part of a picture that is shown, and how finely: curves that stay outside are left out, the
/// others are polylines that nobody can tell from them.
struct SceneWindow {
  Eigen::AlignedBox2d region;  ///< in pixels of the source picture
  double tolerance = 0.1;      ///< between curve and polyline, in pixels of the source picture; > 0
};

/// How many pieces of equal parameter length keep a cubic Bezier curve's polyline within the
/// tolerance: its second derivative is at most 6 times the longest second difference d of the
/// control points, so the distance is at most 3 d / (4 n^2). 1 to 4096.
int curve_segments(const std::array<Eigen::Vector2d, 4>& control, double tolerance);

}  // namespace quadrille
