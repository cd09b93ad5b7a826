#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "subdivision.h"

namespace quadrille {

/// A closed outline: lines and cubics one after another, in pixels of the picture.
struct SvgOutline {
  struct Piece {
    bool is_line;
    Eigen::Vector2d control1, control2;  ///< of a cubic
    Eigen::Vector2d end;
    bool is_exact = false;  ///< ends where rounding would show: on an outline, a tear, an edge
  };
  Eigen::Vector2d start = {0, 0};  ///< as exact as the last piece's end
  std::vector<Piece> pieces;
};

/// Makes a closed outline with few lines. Where the outline need not be exact, it stays within
/// `tolerance` pixels of the lines through the points that are added (Douglas and Peucker, 1973).
class OutlineSimplifier {
 public:
  explicit OutlineSimplifier(double tolerance) : tolerance_(tolerance) {}
  /// A point, and a line from it to what is added next. Where it has a lower tolerance than the
  /// outline, its coordinates are exact.
  void add(const Eigen::Vector2d& point,
           double tolerance = std::numeric_limits<double>::infinity());
  /// A curve that is kept as it is, to where what is added next begins.
  void add_exact(const PlaneCurve& curve) {
    steps_.push_back({true, true, curve[0], curve[1], curve[2], tolerance_});
  }
  SvgOutline outline();

 private:
  struct Step {
    bool is_curve, is_exact;
    Eigen::Vector2d point, control1, control2;
    double tolerance;
  };
  bool ends_curve(std::size_t i) const;
  std::size_t anchor() const;
  void keep_between(std::size_t first, std::size_t last, std::vector<char>& kept) const;

  double tolerance_;
  std::vector<Step> steps_;
};

}  // namespace quadrille
