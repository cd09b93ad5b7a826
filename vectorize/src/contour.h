#pragma once

#include <functional>
#include <vector>

#include "curve_index.h"
#include "quadrille/planar_loops.h"

namespace quadrille {

/// The wished length of mesh edges at a place, source pixels.
using Spacing = std::function<double(const Eigen::Vector2d&)>;

/// A closed polygon by arc length s, which counts modulo the length.
class Contour {
 public:
  explicit Contour(Loop points);

  const Loop& points() const { return points_; }
  double length() const { return arc_.back(); }
  /// Arc length of point i.
  double arc_of(std::size_t i) const { return arc_[i]; }
  /// The point of the polygon whose arc length is nearest to s.
  std::size_t nearest_point(double s) const;
  double distance_along(double s, double t) const;

  Eigen::Vector2d at(double s) const;
  /// Mean over a pixel and a half on either side, less beside marks: without the polygon's steps.
  Eigen::Vector2d smooth_at(double s) const;
  /// Angle in [0, pi] between the chords over `arm` before and after s.
  double turning(double s, double arm) const;
  /// Unit direction of the chord over `arm` on either side.
  Eigen::Vector2d direction(double s, double arm) const;

  /// Marks the corners, turns by more than about 50 degrees that show at the scale of the mesh, and
  /// the ends of the runs along the sides of the rectangle [0, width] x [0, height].
  void find_marks(const Spacing& spacing, double width, double height);
  /// Ascending.
  const std::vector<double>& marks() const { return marks_; }

 private:
  double wrapped(double s) const;
  std::vector<double> frame_ends(const Spacing& spacing, double width, double height) const;
  std::vector<double> corners(const Spacing& spacing) const;

  Loop points_;
  std::vector<double> arc_;  // of each point, and the whole length
  std::vector<double> marks_;
};

/// The segments of some contours for a CurveIndex, numbered as the contours are.
std::vector<CurveSegment> segments_of(const std::vector<Contour>& contours);

}  // namespace quadrille
