#pragma once

#include <Eigen/Geometry>
#include <string>

#include "svg_outline.h"

namespace quadrille {

/// Path data of outlines with coordinates as integers, in units of a part of a pixel; those of
/// exact outlines in tenths of it.
class SvgPathData {
 public:
  explicit SvgPathData(int units_per_pixel) : units_(units_per_pixel) {}

  /// Appends one closed subpath.
  void append(const SvgOutline& outline);
  const std::string& text() const { return text_; }
  /// Tight bounds of the subpaths as written, in pixels: what objectBoundingBox refers to.
  Eigen::AlignedBox2d bounds() const;

 private:
  using Point = Eigen::Matrix<long long, 2, 1>;  ///< in exact units
  static constexpr int kExact = 10;              ///< exact units per unit

  void write(char command, std::initializer_list<Point> points);
  void write_number(long long number, bool separate);
  void line_to(const Point& target);
  void cubic_to(const Point& control1, const Point& control2, const Point& end);

  Point to_exact(const Eigen::Vector2d& p, bool is_exact) const;

  int units_;  ///< per pixel
  std::string text_;
  char command_ = 0;
  Point at_ = Point::Zero();
  Eigen::AlignedBox2d bounds_;
};

}  // namespace quadrille
